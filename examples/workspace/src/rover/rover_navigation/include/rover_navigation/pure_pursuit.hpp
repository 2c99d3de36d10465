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

#ifndef ROVER_NAVIGATION__PURE_PURSUIT_HPP_
#define ROVER_NAVIGATION__PURE_PURSUIT_HPP_

#include "rover_navigation/geometry.hpp"
#include "rover_navigation/path.hpp"

namespace rover_navigation
{

/// How far ahead to look and how fast to drive.
struct PursuitSettings
{
  double lookahead_m = 0.6;
  double lookahead_per_speed_s = 0.5;
  double cruise_m_s = 0.5;
  double turn_rad_s = 0.8;
};

/// Follows a path by steering for a point ahead on it (Coulter 1992).
class PurePursuit
{
public:
  explicit PurePursuit(const PursuitSettings & settings);

  /// Returns the velocity to drive with; none where the path is empty.
  Velocity steer(const Pose & pose, const Velocity & current, const Path & path) const;

private:
  PursuitSettings settings_;
};

}  // namespace rover_navigation

#endif  // ROVER_NAVIGATION__PURE_PURSUIT_HPP_
