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

#ifndef ROVER_BASE__SERIAL_PORT_HPP_
#define ROVER_BASE__SERIAL_PORT_HPP_

#include <cstdint>
#include <string>
#include <vector>

namespace rover_base
{

/// A serial port that never blocks; closed when it goes out of scope.
class SerialPort
{
public:
  SerialPort() = default;
  ~SerialPort();
  SerialPort(const SerialPort &) = delete;
  SerialPort & operator=(const SerialPort &) = delete;

  /// Opens a device with 8 bits, no parity, one stop bit; returns whether that worked.
  bool open(const std::string & device, int baud);
  void close();
  bool is_open() const {return descriptor_ >= 0;}

  /// Returns what has arrived, which may be nothing.
  std::vector<std::uint8_t> read();
  bool write(const std::vector<std::uint8_t> & bytes);

private:
  int descriptor_ = -1;
};

}  // namespace rover_base

#endif  // ROVER_BASE__SERIAL_PORT_HPP_
