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

#include "rover_navigation/pure_pursuit.hpp"

using rover_navigation::Path;
using rover_navigation::Pose;
using rover_navigation::PurePursuit;
using rover_navigation::PursuitSettings;

TEST(PurePursuit, DrivesStraightOnAStraightPath)
{
  const PurePursuit pursuit((PursuitSettings()));
  const auto velocity = pursuit.steer(Pose(), {}, Path({{0, 0}, {5, 0}}));
  EXPECT_DOUBLE_EQ(velocity.linear, 0.5);
  EXPECT_NEAR(velocity.angular, 0.0, 1e-9);
}

TEST(PurePursuit, SteersBackToThePath)
{
  const PurePursuit pursuit((PursuitSettings()));
  const auto velocity = pursuit.steer({{0.0, 0.3}, 0.0}, {}, Path({{0, 0}, {5, 0}}));
  EXPECT_GT(velocity.linear, 0.0);
  EXPECT_LT(velocity.angular, 0.0);
}

TEST(PurePursuit, TurnsTowardsWhatIsBehind)
{
  const PurePursuit pursuit((PursuitSettings()));
  const auto velocity = pursuit.steer(Pose(), {}, Path({{0, 0}, {-5, 1}}));
  EXPECT_DOUBLE_EQ(velocity.linear, 0.0);
  EXPECT_DOUBLE_EQ(velocity.angular, 0.8);
}

TEST(PurePursuit, StaysWithoutAPath)
{
  const PurePursuit pursuit((PursuitSettings()));
  EXPECT_DOUBLE_EQ(pursuit.steer(Pose(), {}, Path()).linear, 0.0);
}
