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

#ifndef ROVER_NAVIGATION__OBSTACLE_RING_HPP_
#define ROVER_NAVIGATION__OBSTACLE_RING_HPP_

#include <array>
#include <cstddef>
#include <vector>

namespace rover_navigation
{

/// The nearest obstacle in each of eight sectors around the rover, from one laser scan.
class ObstacleRing
{
public:
  static constexpr std::size_t kSectors = 8;

  ObstacleRing();

  /// Takes a scan: ranges in metres, the angle of the first and between two of them in radians.
  void update(const std::vector<float> & ranges, double first, double step);

  /// Nearest obstacle in metres within the sector straight ahead, to the left, behind, to the right.
  double ahead() const;
  double left() const;
  double behind() const;
  double right() const;

private:
  std::array<double, kSectors> nearest_;
};

}  // namespace rover_navigation

#endif  // ROVER_NAVIGATION__OBSTACLE_RING_HPP_
