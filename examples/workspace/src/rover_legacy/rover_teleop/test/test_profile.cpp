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

#include <gtest/gtest.h>

#include "rover_teleop/joystick_profile.h"

using rover_teleop::JoystickProfile;

TEST(JoystickProfile, IsDeadInTheMiddle)
{
  const JoystickProfile profile(0.1, 2.0);
  EXPECT_EQ(profile.shaped(0.1), 0.0);
  EXPECT_EQ(profile.shaped(-0.05), 0.0);
}

TEST(JoystickProfile, ReachesTheEndsOnBothSides)
{
  const JoystickProfile profile(0.1, 2.0);
  EXPECT_DOUBLE_EQ(profile.shaped(1.0), 1.0);
  EXPECT_DOUBLE_EQ(profile.shaped(-1.0), -1.0);
  EXPECT_DOUBLE_EQ(profile.shaped(0.55), 0.25);
}
