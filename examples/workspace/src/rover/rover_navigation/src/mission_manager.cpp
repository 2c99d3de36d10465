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

#include "rover_navigation/mission_manager.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace rover_navigation
{

namespace
{

constexpr double kStill_m_s = 0.03;
constexpr double kSlip_m_s = 0.25;
constexpr double kWheelRadius_m = 0.08;
constexpr double kRecovery_s = 1.5;

}  // namespace

MissionManager::MissionManager(const PursuitSettings & pursuit, const SpeedLimits & limits)
: pursuit_(pursuit), limiter_(limits)
{
}

void MissionManager::set_mission(const Mission & mission)
{
  mission_ = mission;
  path_ = mission_.path_from(pose_.place);
  reached_ = 0;
  reason_.clear();
  situation_.attempts = 0;
  situation_.stuck_s = 0.0;
  state_ = mission_.done() ? State::kIdle : State::kDriving;
}

void MissionManager::clear_mission()
{
  mission_ = Mission();
  path_ = Path();
  limiter_.reset();
  state_ = State::kIdle;
}

void MissionManager::pause()
{
  if (busy()) {
    state_ = State::kStopped;
    limiter_.reset();
  }
}

void MissionManager::resume()
{
  if (state_ == State::kStopped && !mission_.done()) {
    path_ = mission_.path_from(pose_.place);
    state_ = State::kDriving;
  }
}

void MissionManager::stop()
{
  finish(false, "stopped by hand");
}

void MissionManager::skip_waypoint()
{
  if (!mission_.done()) {
    mission_.advance();
    path_ = mission_.path_from(pose_.place);
  }
}

void MissionManager::update_pose(const Pose & pose)
{
  driven_m_ += distance(pose_.place, pose.place);
  pose_ = pose;
}

void MissionManager::update_velocity(const Velocity & velocity)
{
  velocity_ = velocity;
}

void MissionManager::update_scan(const std::vector<float> & ranges, double first, double step)
{
  obstacles_.update(ranges, first, step);
}

void MissionManager::update_battery(double share)
{
  situation_.battery = std::clamp(share, 0.0, 1.0);
}

void MissionManager::update_bumper(bool pressed)
{
  situation_.bumper = pressed;
}

void MissionManager::update_localisation(bool good)
{
  situation_.localised = good;
}

void MissionManager::update_wheels(double left_rad_s, double right_rad_s)
{
  const double rolled = (left_rad_s + right_rad_s) / 2.0 * kWheelRadius_m;
  situation_.wheels_slip = std::fabs(rolled - velocity_.linear) > kSlip_m_s;
}

Velocity MissionManager::step(double seconds)
{
  switch (state_) {
    case State::kDriving:
      return drive(seconds);
    case State::kRecovering:
      return recover(seconds);
    case State::kHolding:
      hold_left_s_ -= seconds;
      if (hold_left_s_ <= 0.0) {
        arrive();
      }
      return {};
    default:
      return {};
  }
}

Velocity MissionManager::drive(double seconds)
{
  if (arrived()) {
    if (mission_.current().hold_s > 0.0) {
      hold_left_s_ = mission_.current().hold_s;
      state_ = State::kHolding;
      limiter_.reset();
      return {};
    }
    arrive();
    if (state_ != State::kDriving) {
      return {};
    }
  }
  watch_progress(seconds);
  recovery_ = choose_recovery(situation_, obstacles_);
  if (recovery_ == Recovery::kGiveUp) {
    finish(false, "no way on");
    return {};
  }
  if (recovery_ != Recovery::kNone) {
    ++situation_.attempts;
    situation_.last = recovery_;
    recovery_left_s_ = kRecovery_s;
    state_ = State::kRecovering;
    return {};
  }
  return limiter_.limit(pursuit_.steer(pose_, velocity_, path_), obstacles_, seconds);
}

Velocity MissionManager::recover(double seconds)
{
  recovery_left_s_ -= seconds;
  if (recovery_left_s_ <= 0.0) {
    situation_.stuck_s = 0.0;
    state_ = State::kDriving;
    path_ = mission_.path_from(pose_.place);
    return {};
  }
  switch (recovery_) {
    case Recovery::kBackUp:
      return limiter_.limit({-0.2, 0.0}, obstacles_, seconds);
    case Recovery::kTurnLeft:
      return limiter_.limit({0.0, 0.6}, obstacles_, seconds);
    case Recovery::kTurnRight:
      return limiter_.limit({0.0, -0.6}, obstacles_, seconds);
    default:
      return {};
  }
}

bool MissionManager::arrived() const
{
  return !mission_.done() &&
         distance(pose_.place, mission_.current().place) <= mission_.current().tolerance_m;
}

void MissionManager::arrive()
{
  const Waypoint waypoint = mission_.current();
  ++reached_;
  situation_.attempts = 0;
  situation_.last = Recovery::kNone;
  mission_.advance();
  state_ = State::kDriving;
  if (reached_callback_) {
    reached_callback_(waypoint);
  }
  if (mission_.done()) {
    finish(true, "");
    return;
  }
  path_ = mission_.path_from(pose_.place);
}

void MissionManager::finish(bool success, const std::string & reason)
{
  clear_mission();
  reason_ = reason;
  if (finished_callback_) {
    finished_callback_(success, reason);
  }
}

void MissionManager::watch_progress(double seconds)
{
  if (std::fabs(velocity_.linear) < kStill_m_s && std::fabs(limiter_.last().linear) > kStill_m_s) {
    situation_.stuck_s += seconds;
  } else {
    situation_.stuck_s = 0.0;
  }
}

std::string MissionManager::state_name() const
{
  switch (state_) {
    case State::kIdle:
      return "idle";
    case State::kDriving:
      return "driving";
    case State::kHolding:
      return "holding";
    case State::kRecovering:
      return "recovering";
    default:
      return "stopped";
  }
}

bool MissionManager::busy() const
{
  return state_ == State::kDriving || state_ == State::kHolding || state_ == State::kRecovering;
}

std::string MissionManager::waypoint_name() const
{
  return mission_.done() ? "" : mission_.current().name;
}

double MissionManager::remaining() const
{
  return path_.empty() ? 0.0 : path_.length() - path_.along(pose_.place);
}

void MissionManager::on_reached(std::function<void(const Waypoint &)> callback)
{
  reached_callback_ = std::move(callback);
}

void MissionManager::on_finished(std::function<void(bool, const std::string &)> callback)
{
  finished_callback_ = std::move(callback);
}

}  // namespace rover_navigation
