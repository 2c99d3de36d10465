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

#ifndef ROVER_NAVIGATION__PATH_HPP_
#define ROVER_NAVIGATION__PATH_HPP_

#include <cstddef>
#include <vector>

#include "rover_navigation/geometry.hpp"

namespace rover_navigation
{

/// A chain of straight pieces between points.
class Path
{
public:
  Path() = default;
  explicit Path(std::vector<Point> points);

  bool empty() const {return points_.empty();}
  const Point & goal() const {return points_.back();}

  /// Length of the whole path in metres.
  double length() const;

  /// Returns how far along the path (in metres) its nearest place to `point` is.
  double along(const Point & point) const;

  /// Returns the place a number of metres along the path; its ends where that is outside.
  Point at(double metres) const;

private:
  std::vector<Point> points_;
  std::vector<double> starts_;  // metres along the path at which each point is
};

}  // namespace rover_navigation

#endif  // ROVER_NAVIGATION__PATH_HPP_
