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

#ifndef ROVER_BASE__ODOMETRY_HPP_
#define ROVER_BASE__ODOMETRY_HPP_

namespace rover_base
{

/// The geometry of the drive, in metres.
struct DriveGeometry
{
  double wheel_radius_m = 0.08;
  double track_m = 0.42;
};

/// Where the rover is, by its wheels alone.
struct Pose
{
  double x_m = 0.0;
  double y_m = 0.0;
  double heading_rad = 0.0;
};

/// Speed of the rover: along its axis and around the vertical.
struct Twist
{
  double linear_m_s = 0.0;
  double angular_rad_s = 0.0;
};

/// Adds up wheel speeds to a pose and turns twists into wheel speeds.
class Odometry
{
public:
  explicit Odometry(const DriveGeometry & geometry);

  /// Moves the pose by what the wheels did during `seconds`.
  void update(double left_rad_s, double right_rad_s, double seconds);

  /// Puts the pose back to the origin.
  void reset();

  const Pose & pose() const {return pose_;}
  const Twist & twist() const {return twist_;}

  double left_of(const Twist & twist) const;
  double right_of(const Twist & twist) const;

private:
  DriveGeometry geometry_;
  Pose pose_;
  Twist twist_;
};

}  // namespace rover_base

#endif  // ROVER_BASE__ODOMETRY_HPP_
