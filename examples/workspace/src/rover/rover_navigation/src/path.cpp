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

#include "rover_navigation/path.hpp"

#include <algorithm>
#include <limits>
#include <utility>

namespace rover_navigation
{

Path::Path(std::vector<Point> points)
: points_(std::move(points))
{
  double metres = 0.0;
  for (std::size_t i = 0; i < points_.size(); ++i) {
    if (i > 0) {
      metres += distance(points_[i - 1], points_[i]);
    }
    starts_.push_back(metres);
  }
}

double Path::length() const
{
  return starts_.empty() ? 0.0 : starts_.back();
}

double Path::along(const Point & point) const
{
  double nearest = std::numeric_limits<double>::infinity();
  double metres = 0.0;
  for (std::size_t i = 0; i + 1 < points_.size(); ++i) {
    const Point & a = points_[i];
    const Point & b = points_[i + 1];
    const double dx = b.x - a.x;
    const double dy = b.y - a.y;
    const double squared = dx * dx + dy * dy;
    // A piece without a length has one place only.
    const double share = squared > 0.0 ?
      std::clamp(((point.x - a.x) * dx + (point.y - a.y) * dy) / squared, 0.0, 1.0) : 0.0;
    const double away = distance(point, {a.x + share * dx, a.y + share * dy});
    if (away < nearest) {
      nearest = away;
      metres = starts_[i] + share * (starts_[i + 1] - starts_[i]);
    }
  }
  return metres;
}

Point Path::at(double metres) const
{
  if (metres <= 0.0 || points_.size() < 2) {
    return points_.front();
  }
  const auto next = std::upper_bound(starts_.begin(), starts_.end(), metres);
  if (next == starts_.end()) {
    return points_.back();
  }
  const std::size_t i = static_cast<std::size_t>(next - starts_.begin());
  const double share = (metres - starts_[i - 1]) / (starts_[i] - starts_[i - 1]);
  const Point & a = points_[i - 1];
  const Point & b = points_[i];
  return {a.x + share * (b.x - a.x), a.y + share * (b.y - a.y)};
}

}  // namespace rover_navigation
