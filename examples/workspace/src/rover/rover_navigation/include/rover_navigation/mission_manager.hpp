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

#ifndef ROVER_NAVIGATION__MISSION_MANAGER_HPP_
#define ROVER_NAVIGATION__MISSION_MANAGER_HPP_

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "rover_navigation/geometry.hpp"
#include "rover_navigation/mission.hpp"
#include "rover_navigation/obstacle_ring.hpp"
#include "rover_navigation/path.hpp"
#include "rover_navigation/pure_pursuit.hpp"
#include "rover_navigation/recovery.hpp"
#include "rover_navigation/speed_limiter.hpp"

namespace rover_navigation
{

enum class State
{
  kIdle,
  kDriving,
  kHolding,
  kRecovering,
  kStopped
};

/// Does everything at once. Deliberately left so: it knows every other class and offers far too much.
class MissionManager
{
public:
  MissionManager(const PursuitSettings & pursuit, const SpeedLimits & limits);

  void set_mission(const Mission & mission);
  void clear_mission();
  void pause();
  void resume();
  void stop();
  void skip_waypoint();

  void update_pose(const Pose & pose);
  void update_velocity(const Velocity & velocity);
  void update_scan(const std::vector<float> & ranges, double first, double step);
  void update_battery(double share);
  void update_bumper(bool pressed);
  void update_localisation(bool good);
  void update_wheels(double left_rad_s, double right_rad_s);

  Velocity step(double seconds);

  State state() const {return state_;}
  std::string state_name() const;
  bool busy() const;
  std::string waypoint_name() const;
  std::size_t reached() const {return reached_;}
  std::size_t next() const {return mission_.next();}
  double remaining() const;
  double driven() const {return driven_m_;}
  double battery() const {return situation_.battery;}
  const Situation & situation() const {return situation_;}
  const std::string & reason() const {return reason_;}

  void on_reached(std::function<void(const Waypoint &)> callback);
  void on_finished(std::function<void(bool, const std::string &)> callback);

private:
  Velocity drive(double seconds);
  Velocity recover(double seconds);
  bool arrived() const;
  void arrive();
  void finish(bool success, const std::string & reason);
  void watch_progress(double seconds);

  PurePursuit pursuit_;
  SpeedLimiter limiter_;
  ObstacleRing obstacles_;
  Mission mission_;
  Path path_;
  Pose pose_;
  Velocity velocity_;
  Situation situation_;
  Recovery recovery_ = Recovery::kNone;
  State state_ = State::kIdle;
  double hold_left_s_ = 0.0;
  double recovery_left_s_ = 0.0;
  double driven_m_ = 0.0;
  std::size_t reached_ = 0;
  std::string reason_;
  std::function<void(const Waypoint &)> reached_callback_;
  std::function<void(bool, const std::string &)> finished_callback_;
};

}  // namespace rover_navigation

#endif  // ROVER_NAVIGATION__MISSION_MANAGER_HPP_
