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

#ifndef ROVER_NAVIGATION__RECOVERY_HPP_
#define ROVER_NAVIGATION__RECOVERY_HPP_

#include "rover_navigation/obstacle_ring.hpp"

namespace rover_navigation
{

/// Ways out of trouble, from the mildest to the last.
enum class Recovery
{
  kNone,
  kWait,
  kBackUp,
  kTurnLeft,
  kTurnRight,
  kGiveUp
};

/// What is known when the rover does not get on.
struct Situation
{
  double stuck_s = 0.0;
  double battery = 1.0;
  int attempts = 0;
  bool wheels_slip = false;
  bool bumper = false;
  bool localised = true;
  Recovery last = Recovery::kNone;
};

/// Returns what to try next.
Recovery choose_recovery(const Situation & situation, const ObstacleRing & obstacles);

}  // namespace rover_navigation

#endif  // ROVER_NAVIGATION__RECOVERY_HPP_
