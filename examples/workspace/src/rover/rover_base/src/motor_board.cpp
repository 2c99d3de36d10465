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

#include "rover_base/motor_board.hpp"

#include <algorithm>
#include <cstddef>

#include "crc8.h"
#include "rover_base/pwm_table.hpp"

namespace rover_base
{

namespace
{

constexpr std::uint8_t kStart = 0xA5;
constexpr std::uint8_t kSetSpeeds = 0x01;
constexpr std::uint8_t kReport = 0x81;
constexpr std::size_t kReportPayload = 11;
constexpr std::size_t kOverhead = 3;  // start, length, crc

std::int16_t read_i16(const std::uint8_t * bytes)
{
  return static_cast<std::int16_t>(bytes[0] | (bytes[1] << 8));
}

void append_i16(std::vector<std::uint8_t> & frame, std::int16_t value)
{
  frame.push_back(static_cast<std::uint8_t>(value & 0xFF));
  frame.push_back(static_cast<std::uint8_t>((value >> 8) & 0xFF));
}

// The board counts milliradians per second, milliamperes and centivolts.
MotorReport decode(const std::uint8_t * payload)
{
  MotorReport report;
  report.left_rad_s = read_i16(payload + 1) / 1000.0;
  report.right_rad_s = read_i16(payload + 3) / 1000.0;
  report.current_a = read_i16(payload + 5) / 1000.0;
  report.voltage_v = read_i16(payload + 7) / 100.0;
  report.faults = static_cast<std::uint16_t>(read_i16(payload + 9));
  return report;
}

}  // namespace

std::vector<std::uint8_t> MotorBoard::frame(const MotorCommand & command) const
{
  std::vector<std::uint8_t> bytes{kStart, 5, kSetSpeeds};
  append_i16(bytes, pwm_of(command.left_rad_s));
  append_i16(bytes, pwm_of(command.right_rad_s));
  bytes.push_back(crc8(bytes.data() + 1, bytes.size() - 1));
  return bytes;
}

std::optional<MotorReport> MotorBoard::feed(const std::vector<std::uint8_t> & bytes)
{
  pending_.insert(pending_.end(), bytes.begin(), bytes.end());
  std::optional<MotorReport> last;
  while (true) {
    const auto start = std::find(pending_.begin(), pending_.end(), kStart);
    pending_.erase(pending_.begin(), start);
    // Wait for the rest when the frame is not whole yet.
    if (pending_.size() < 2 || pending_.size() < pending_[1] + kOverhead) {
      return last;
    }
    if (const auto report = take_frame()) {
      last = report;
    }
  }
}

std::optional<MotorReport> MotorBoard::take_frame()
{
  const std::size_t length = pending_[1];
  const std::uint8_t expected = crc8(pending_.data() + 1, length + 1);
  if (expected != pending_[length + 2]) {
    // Drop the start byte only: a real frame may begin inside the broken one.
    ++broken_frames_;
    pending_.erase(pending_.begin());
    return std::nullopt;
  }
  std::optional<MotorReport> report;
  if (length == kReportPayload && pending_[2] == kReport) {
    report = decode(pending_.data() + 2);
  }
  pending_.erase(pending_.begin(), pending_.begin() + static_cast<std::ptrdiff_t>(length + kOverhead));
  return report;
}

}  // namespace rover_base
