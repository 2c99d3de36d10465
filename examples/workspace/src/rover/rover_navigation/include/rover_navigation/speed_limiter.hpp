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

#ifndef ROVER_NAVIGATION__SPEED_LIMITER_HPP_
#define ROVER_NAVIGATION__SPEED_LIMITER_HPP_

#include "rover_navigation/geometry.hpp"
#include "rover_navigation/obstacle_ring.hpp"

namespace rover_navigation
{

/// What the motors and the load stand.
struct SpeedLimits
{
  double linear_m_s = 0.8;
  double angular_rad_s = 1.2;
  double acceleration_m_s2 = 0.6;
  double stop_at_m = 0.35;
  double slow_at_m = 1.0;
};

/// Keeps velocities within limits, smooth, and slow near obstacles.
class SpeedLimiter
{
public:
  explicit SpeedLimiter(const SpeedLimits & limits);

  /// Returns what may be driven next when `wanted` is asked for, `seconds` after the last call.
  Velocity limit(const Velocity & wanted, const ObstacleRing & obstacles, double seconds);

  /// Forgets the last velocity, after a stop that came from elsewhere.
  void reset() {last_ = Velocity();}

  const Velocity & last() const {return last_;}

private:
  SpeedLimits limits_;
  Velocity last_;
};

}  // namespace rover_navigation

#endif  // ROVER_NAVIGATION__SPEED_LIMITER_HPP_
