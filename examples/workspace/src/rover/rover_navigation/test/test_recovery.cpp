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

#include <vector>

#include "rover_navigation/recovery.hpp"

using rover_navigation::ObstacleRing;
using rover_navigation::Recovery;
using rover_navigation::Situation;
using rover_navigation::choose_recovery;

TEST(Recovery, NothingIsDoneAtOnce)
{
  EXPECT_EQ(choose_recovery(Situation(), ObstacleRing()), Recovery::kNone);
}

TEST(Recovery, TheBumperMeansBack)
{
  Situation situation;
  situation.bumper = true;
  EXPECT_EQ(choose_recovery(situation, ObstacleRing()), Recovery::kBackUp);
}

TEST(Recovery, AnEmptyBatteryMeansTheEnd)
{
  Situation situation;
  situation.battery = 0.01;
  EXPECT_EQ(choose_recovery(situation, ObstacleRing()), Recovery::kGiveUp);
}

TEST(Recovery, WaitsBeforeItTurns)
{
  Situation situation;
  situation.stuck_s = 2.0;
  EXPECT_EQ(choose_recovery(situation, ObstacleRing()), Recovery::kWait);
  situation.last = Recovery::kWait;
  ObstacleRing obstacles;
  obstacles.update({2.0F, 0.6F}, 0.0, 1.5);
  EXPECT_EQ(choose_recovery(situation, obstacles), Recovery::kTurnRight);
}
