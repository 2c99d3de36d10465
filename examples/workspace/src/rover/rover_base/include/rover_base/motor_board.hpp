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

#ifndef ROVER_BASE__MOTOR_BOARD_HPP_
#define ROVER_BASE__MOTOR_BOARD_HPP_

#include <cstdint>
#include <optional>
#include <vector>

namespace rover_base
{

/// What the motor board reports, in SI units.
struct MotorReport
{
  double left_rad_s = 0.0;
  double right_rad_s = 0.0;
  double current_a = 0.0;
  double voltage_v = 0.0;
  std::uint16_t faults = 0;
};

/// Speeds the board shall keep, in rad/s at the wheels.
struct MotorCommand
{
  double left_rad_s = 0.0;
  double right_rad_s = 0.0;
};

/// Turns commands into frames and bytes into reports.
///
/// A frame is `0xA5 length payload… crc`; the crc covers length and payload. Bytes that belong to
/// no whole frame are kept until the rest of it arrives or the next start byte shows that it will not.
class MotorBoard
{
public:
  /// Returns the frame that sets both wheel speeds.
  std::vector<std::uint8_t> frame(const MotorCommand & command) const;

  /// Takes bytes as they arrive and returns the last whole report among them.
  std::optional<MotorReport> feed(const std::vector<std::uint8_t> & bytes);

  /// Frames whose crc was wrong since the start.
  std::uint32_t broken_frames() const {return broken_frames_;}

private:
  std::optional<MotorReport> take_frame();

  std::vector<std::uint8_t> pending_;
  std::uint32_t broken_frames_ = 0;
};

}  // namespace rover_base

#endif  // ROVER_BASE__MOTOR_BOARD_HPP_
