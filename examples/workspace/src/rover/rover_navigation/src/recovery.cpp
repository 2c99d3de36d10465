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

#include "rover_navigation/recovery.hpp"

namespace rover_navigation
{

// Grew case by case in field tests. Deliberately left as it grew: far too many decisions, far too deep.
Recovery choose_recovery(const Situation & situation, const ObstacleRing & obstacles)
{
  const double ahead = obstacles.ahead();
  const double behind = obstacles.behind();
  const double left = obstacles.left();
  const double right = obstacles.right();

  if (situation.battery < 0.05 || situation.attempts > 12) {
    return Recovery::kGiveUp;
  }
  if (situation.stuck_s < 1.0 && !situation.bumper) {
    return Recovery::kNone;
  }
  if (!situation.localised) {
    if (situation.stuck_s < 5.0) {
      return Recovery::kWait;
    } else if (situation.attempts < 3) {
      // Turning shows the scanner something else.
      return left > right ? Recovery::kTurnLeft : Recovery::kTurnRight;
    }
    return Recovery::kGiveUp;
  }
  if (situation.bumper) {
    if (behind > 0.4) {
      return Recovery::kBackUp;
    }
    for (int attempt = 0; attempt < 2; ++attempt) {
      const bool try_left = attempt == 0 ? left >= right : left < right;
      if (try_left && left > 0.3) {
        if (situation.last != Recovery::kTurnLeft || situation.attempts % 2 == 0) {
          return Recovery::kTurnLeft;
        }
      } else if (!try_left && right > 0.3) {
        if (situation.last != Recovery::kTurnRight || situation.attempts % 2 == 0) {
          return Recovery::kTurnRight;
        }
      }
    }
    return Recovery::kWait;
  }
  if (situation.wheels_slip) {
    if (ahead > 1.0 && situation.attempts == 0) {
      return Recovery::kWait;
    } else if (behind > 0.6) {
      if (situation.last == Recovery::kBackUp) {
        if (left > 0.8 || right > 0.8) {
          if (left > right) {
            if (situation.attempts < 6) {
              if (situation.battery > 0.2) {
                return Recovery::kTurnLeft;
              }
            } else if (right > 0.8) {
              return Recovery::kTurnRight;
            }
          } else {
            if (situation.attempts < 6) {
              if (situation.battery > 0.2) {
                return Recovery::kTurnRight;
              }
            } else if (left > 0.8) {
              return Recovery::kTurnLeft;
            }
          }
        }
        return situation.attempts < 9 ? Recovery::kWait : Recovery::kGiveUp;
      }
      return Recovery::kBackUp;
    }
  }
  switch (situation.last) {
    case Recovery::kNone:
      return Recovery::kWait;
    case Recovery::kWait:
      if (ahead < 0.5 && behind > 0.5) {
        return Recovery::kBackUp;
      }
      return left > right ? Recovery::kTurnLeft : Recovery::kTurnRight;
    case Recovery::kBackUp:
      return (left > right && left > 0.5) || right < 0.5 ? Recovery::kTurnLeft : Recovery::kTurnRight;
    case Recovery::kTurnLeft:
      return situation.attempts > 4 && right > 0.5 ? Recovery::kTurnRight : Recovery::kWait;
    case Recovery::kTurnRight:
      return situation.attempts > 4 && left > 0.5 ? Recovery::kTurnLeft : Recovery::kWait;
    default:
      return Recovery::kGiveUp;
  }
}

}  // namespace rover_navigation
