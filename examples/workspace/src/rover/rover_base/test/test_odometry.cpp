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

#include <cmath>

#include "rover_base/odometry.hpp"

using rover_base::DriveGeometry;
using rover_base::Odometry;
using rover_base::Twist;

TEST(Odometry, DrivesStraight)
{
  Odometry odometry((DriveGeometry()));
  for (int i = 0; i < 50; ++i) {
    odometry.update(10.0, 10.0, 0.02);
  }
  EXPECT_NEAR(odometry.pose().x_m, 0.8, 1e-9);
  EXPECT_NEAR(odometry.pose().y_m, 0.0, 1e-9);
}

TEST(Odometry, TurnsOnTheSpot)
{
  Odometry odometry((DriveGeometry()));
  odometry.update(-5.0, 5.0, 0.1);
  EXPECT_NEAR(odometry.pose().heading_rad, 0.08 / 0.42, 1e-9);
  EXPECT_NEAR(odometry.pose().x_m, 0.0, 1e-9);
}

TEST(Odometry, WheelSpeedsComeBackAsTheTwist)
{
  Odometry odometry((DriveGeometry()));
  const Twist twist{0.6, -0.4};
  odometry.update(odometry.left_of(twist), odometry.right_of(twist), 0.02);
  EXPECT_NEAR(odometry.twist().linear_m_s, 0.6, 1e-9);
  EXPECT_NEAR(odometry.twist().angular_rad_s, -0.4, 1e-9);
}
