#ifndef BARROW_OPTICS__LENS_HPP_
#define BARROW_OPTICS__LENS_HPP_

#include "sensor_msgs/msg/camera_info.hpp"

namespace barrow_optics
{
double focal_length(const sensor_msgs::msg::CameraInfo & info);
}  // namespace barrow_optics

#endif  // BARROW_OPTICS__LENS_HPP_
