#ifndef BARROW_BASE_WHEEL_H
#define BARROW_BASE_WHEEL_H

namespace barrow_base
{
constexpr double kWheelRadius = 0.21;  // m
}

#endif  // BARROW_BASE_WHEEL_H
