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

#include <cstdint>
#include <vector>

#include "crc8.h"
#include "rover_base/motor_board.hpp"

using rover_base::MotorBoard;

static std::vector<std::uint8_t> report_frame()
{
  std::vector<std::uint8_t> frame{0xA5, 11, 0x81, 0xE8, 0x03, 0x18, 0xFC, 0x64, 0, 0xB8, 0x04, 2, 0};
  frame.push_back(crc8(frame.data() + 1, frame.size() - 1));
  return frame;
}

TEST(MotorBoard, ReadsAReportThatArrivesInPieces)
{
  MotorBoard board;
  const auto frame = report_frame();
  for (std::size_t i = 0; i + 1 < frame.size(); ++i) {
    EXPECT_FALSE(board.feed({frame[i]}));
  }
  const auto report = board.feed({frame.back()});
  ASSERT_TRUE(report);
  EXPECT_DOUBLE_EQ(report->left_rad_s, 1.0);
  EXPECT_DOUBLE_EQ(report->right_rad_s, -1.0);
  EXPECT_DOUBLE_EQ(report->voltage_v, 12.08);
  EXPECT_EQ(report->faults, 2);
}

TEST(MotorBoard, FindsTheNextFrameAfterABrokenOne)
{
  MotorBoard board;
  auto bytes = report_frame();
  bytes[4] ^= 0x40;
  const auto good = report_frame();
  bytes.insert(bytes.end(), good.begin(), good.end());
  EXPECT_TRUE(board.feed(bytes));
  EXPECT_EQ(board.broken_frames(), 1u);
}
