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

#ifndef ROVER_NAVIGATION__GEOMETRY_HPP_
#define ROVER_NAVIGATION__GEOMETRY_HPP_

#include <cmath>

namespace rover_navigation
{

/// A place on the ground, in metres.
struct Point
{
  double x = 0.0;
  double y = 0.0;
};

/// A place and where the rover looks, in radians against the x axis.
struct Pose
{
  Point place;
  double heading = 0.0;
};

/// A velocity: along the axis of the rover (m/s) and around the vertical (rad/s).
struct Velocity
{
  double linear = 0.0;
  double angular = 0.0;
};

inline double distance(const Point & a, const Point & b)
{
  return std::hypot(b.x - a.x, b.y - a.y);
}

/// Returns the angle between -pi and pi that points the same way.
inline double wrapped(double angle)
{
  return std::remainder(angle, 2.0 * M_PI);
}

/// Returns where `target` is as the rover sees it: x ahead, y to its left.
inline Point seen_from(const Pose & pose, const Point & target)
{
  const double dx = target.x - pose.place.x;
  const double dy = target.y - pose.place.y;
  const double c = std::cos(pose.heading);
  const double s = std::sin(pose.heading);
  return {c * dx + s * dy, -s * dx + c * dy};
}

}  // namespace rover_navigation

#endif  // ROVER_NAVIGATION__GEOMETRY_HPP_
