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

#ifndef ROVER_NAVIGATION__MISSION_HPP_
#define ROVER_NAVIGATION__MISSION_HPP_

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "rover_navigation/geometry.hpp"
#include "rover_navigation/path.hpp"

namespace rover_navigation
{

/// A place to drive to, and whether to rest there.
struct Waypoint
{
  std::string name;
  Point place;
  double tolerance_m = 0.25;
  double hold_s = 0.0;
};

/// Waypoints in order, with the one driven to.
class Mission
{
public:
  Mission() = default;
  explicit Mission(std::vector<Waypoint> waypoints, bool loop = false)
  : waypoints_(std::move(waypoints)), loop_(loop) {}

  bool done() const {return next_ >= waypoints_.size();}
  std::size_t next() const {return next_;}
  std::size_t size() const {return waypoints_.size();}
  const Waypoint & current() const {return waypoints_[next_];}

  /// Goes on to the next waypoint; a loop starts again after the last.
  void advance()
  {
    ++next_;
    if (loop_ && next_ >= waypoints_.size()) {
      next_ = 0;
    }
  }

  /// Returns the way from a place over the waypoints that are left.
  Path path_from(const Point & start) const
  {
    std::vector<Point> points{start};
    for (std::size_t i = next_; i < waypoints_.size(); ++i) {
      points.push_back(waypoints_[i].place);
    }
    return Path(std::move(points));
  }

private:
  std::vector<Waypoint> waypoints_;
  std::size_t next_ = 0;
  bool loop_ = false;
};

}  // namespace rover_navigation

#endif  // ROVER_NAVIGATION__MISSION_HPP_
