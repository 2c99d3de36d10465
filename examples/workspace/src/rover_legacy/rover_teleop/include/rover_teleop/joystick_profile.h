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

#ifndef ROVER_TELEOP_JOYSTICK_PROFILE_H
#define ROVER_TELEOP_JOYSTICK_PROFILE_H

namespace rover_teleop
{

/// Turns the way a stick is pushed into a speed: nothing in the middle, gentle around it.
class JoystickProfile
{
public:
  /// `dead_zone` is the share of the way around the middle that means nothing.
  JoystickProfile(double dead_zone, double exponent);

  /// Returns -1 to 1 for a stick at -1 to 1.
  double shaped(double stick) const;

private:
  double dead_zone_;
  double exponent_;
};

}  // namespace rover_teleop

#endif  // ROVER_TELEOP_JOYSTICK_PROFILE_H
