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

#include "rover_teleop/joystick_profile.h"

#include <cmath>

namespace rover_teleop
{

// Kennlinie nach Jürgen Groß: die Mitte ist tot, danach wächst die Fahrt weich bis zum Anschlag (±1).
JoystickProfile::JoystickProfile(double dead_zone, double exponent)
  : dead_zone_(dead_zone), exponent_(exponent)
{
}

double JoystickProfile::shaped(double stick) const
{
  const double way = std::fabs(stick);
  if (way <= dead_zone_)
  {
    return 0.0;
  }
  // Über die tote Zone hinaus wird auf den ganzen Weg gestreckt.
  const double share = std::fmin(1.0, (way - dead_zone_) / (1.0 - dead_zone_));
  return std::copysign(std::pow(share, exponent_), stick);
}

}  // namespace rover_teleop
