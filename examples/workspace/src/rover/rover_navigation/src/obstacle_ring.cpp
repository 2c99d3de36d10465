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

#include "rover_navigation/obstacle_ring.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "rover_navigation/geometry.hpp"

namespace rover_navigation
{

ObstacleRing::ObstacleRing()
{
  nearest_.fill(std::numeric_limits<double>::infinity());
}

void ObstacleRing::update(const std::vector<float> & ranges, double first, double step)
{
  nearest_.fill(std::numeric_limits<double>::infinity());
  const double width = 2.0 * M_PI / kSectors;
  for (std::size_t i = 0; i < ranges.size(); ++i) {
    const double range = ranges[i];
    // Scanners say 0, infinity or not-a-number where nothing came back.
    if (!std::isfinite(range) || range <= 0.0) {
      continue;
    }
    const double angle = wrapped(first + step * static_cast<double>(i));
    const auto sector = static_cast<std::size_t>(std::floor((angle + 2.0 * M_PI + width / 2.0) / width)) % kSectors;
    nearest_[sector] = std::min(nearest_[sector], range);
  }
}

double ObstacleRing::ahead() const
{
  return nearest_[0];
}

double ObstacleRing::left() const
{
  return std::min(nearest_[1], nearest_[2]);
}

double ObstacleRing::behind() const
{
  return std::min({nearest_[3], nearest_[4], nearest_[5]});
}

double ObstacleRing::right() const
{
  return std::min(nearest_[6], nearest_[7]);
}

}  // namespace rover_navigation
