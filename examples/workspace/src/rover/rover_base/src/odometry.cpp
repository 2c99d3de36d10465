// Copyright 2025 The roslens authors
//
// Licensed under the Apache License, Version 2.0 (the "License");
// you may not use this file except in compliance with the License.
// You may obtain a copy of the License at
//
//     http://www.apache.org/licenses/LICENSE-2.0
//
// Unless required by applicable law or agreed to in writing, software
// distributed under the License is distributed on an "AS IS" BASIS,
// WITHOUT WARRANTIES OR CONDITIONS OF ANY KIND, either express or implied.
// See the License for the specific language governing permissions and
// limitations under the License.

#include "rover_base/odometry.hpp"

#include <cmath>

namespace rover_base
{

Odometry::Odometry(const DriveGeometry & geometry)
: geometry_(geometry)
{
}

void Odometry::update(double left_rad_s, double right_rad_s, double seconds)
{
  const double left = left_rad_s * geometry_.wheel_radius_m;
  const double right = right_rad_s * geometry_.wheel_radius_m;
  twist_.linear_m_s = (left + right) / 2.0;
  twist_.angular_rad_s = (right - left) / geometry_.track_m;

  // Midpoint rule: exact enough for the 50 Hz of the board, and without the pole of the exact arc.
  const double turned = twist_.angular_rad_s * seconds;
  const double middle = pose_.heading_rad + turned / 2.0;
  pose_.x_m += twist_.linear_m_s * seconds * std::cos(middle);
  pose_.y_m += twist_.linear_m_s * seconds * std::sin(middle);
  pose_.heading_rad = std::remainder(pose_.heading_rad + turned, 2.0 * M_PI);
}

void Odometry::reset()
{
  pose_ = Pose();
  twist_ = Twist();
}

double Odometry::left_of(const Twist & twist) const
{
  return (twist.linear_m_s - twist.angular_rad_s * geometry_.track_m / 2.0) / geometry_.wheel_radius_m;
}

double Odometry::right_of(const Twist & twist) const
{
  return (twist.linear_m_s + twist.angular_rad_s * geometry_.track_m / 2.0) / geometry_.wheel_radius_m;
}

}  // namespace rover_base
