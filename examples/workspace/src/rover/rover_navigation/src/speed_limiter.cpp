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

#include "rover_navigation/speed_limiter.hpp"

#include <algorithm>

namespace rover_navigation
{

SpeedLimiter::SpeedLimiter(const SpeedLimits & limits)
: limits_(limits)
{
}

Velocity SpeedLimiter::limit(const Velocity & wanted, const ObstacleRing & obstacles, double seconds)
{
  const double free = wanted.linear >= 0.0 ? obstacles.ahead() : obstacles.behind();
  const double share = std::clamp(
    (free - limits_.stop_at_m) / (limits_.slow_at_m - limits_.stop_at_m), 0.0, 1.0);
  const double linear = share * std::clamp(wanted.linear, -limits_.linear_m_s, limits_.linear_m_s);
  const double step = limits_.acceleration_m_s2 * seconds;

  Velocity next;
  // Braking for an obstacle may be as hard as it has to be.
  next.linear = share < 1.0 ? linear : std::clamp(linear, last_.linear - step, last_.linear + step);
  next.angular = std::clamp(wanted.angular, -limits_.angular_rad_s, limits_.angular_rad_s);
  last_ = next;
  return next;
}

}  // namespace rover_navigation
