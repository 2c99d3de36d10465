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

#include "rover_navigation/pure_pursuit.hpp"

#include <algorithm>
#include <cmath>

namespace rover_navigation
{

PurePursuit::PurePursuit(const PursuitSettings & settings)
: settings_(settings)
{
}

Velocity PurePursuit::steer(const Pose & pose, const Velocity & current, const Path & path) const
{
  if (path.empty()) {
    return {};
  }
  const double ahead = settings_.lookahead_m + settings_.lookahead_per_speed_s * std::fabs(current.linear);
  const Point target = seen_from(pose, path.at(path.along(pose.place) + ahead));

  // What lies behind cannot be reached on an arc without a detour: turn first.
  if (target.x <= 0.0) {
    return {0.0, std::copysign(settings_.turn_rad_s, target.y)};
  }
  const double squared = std::max(target.x * target.x + target.y * target.y, 1e-6);
  const double curvature = 2.0 * target.y / squared;
  const double linear = std::min(settings_.cruise_m_s, settings_.turn_rad_s / std::max(std::fabs(curvature), 1e-6));
  return {linear, linear * curvature};
}

}  // namespace rover_navigation
