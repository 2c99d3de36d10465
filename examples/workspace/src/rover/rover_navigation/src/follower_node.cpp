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

#include <chrono>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "geometry_msgs/msg/twist.hpp"
#include "nav_msgs/msg/odometry.hpp"
#include "rclcpp/rclcpp.hpp"
#include "rclcpp_action/rclcpp_action.hpp"
#include "rover_msgs/action/follow_mission.hpp"
#include "rover_msgs/msg/motor_status.hpp"
#include "rover_msgs/msg/rover_state.hpp"
#include "rover_msgs/srv/set_mission.hpp"
#include "rover_navigation/mission_manager.hpp"
#include "sensor_msgs/msg/battery_state.hpp"
#include "sensor_msgs/msg/laser_scan.hpp"

namespace rover_navigation
{

using FollowMission = rover_msgs::action::FollowMission;
using GoalHandle = rclcpp_action::ServerGoalHandle<FollowMission>;
using SetMission = rover_msgs::srv::SetMission;

constexpr double kPeriod_s = 0.05;

/// The ROS side of the mission manager: topics in, velocity and state out, missions by service and action.
class FollowerNode : public rclcpp::Node
{
public:
  FollowerNode()
  : Node("rover_follower"), manager_(declared_pursuit(), declared_limits())
  {
    velocity_publisher_ = create_publisher<geometry_msgs::msg::Twist>("cmd_vel", 10);
    state_publisher_ = create_publisher<rover_msgs::msg::RoverState>("rover_state", 10);
    subscribe();
    mission_service_ = create_service<SetMission>(
      "set_mission",
      [this](const std::shared_ptr<SetMission::Request> request, std::shared_ptr<SetMission::Response> response) {
        set_mission(*request, *response);
      });
    mission_action_ = rclcpp_action::create_server<FollowMission>(
      this, "follow_mission",
      [](const rclcpp_action::GoalUUID &, std::shared_ptr<const FollowMission::Goal> goal) {
        return goal->waypoints.empty() ? rclcpp_action::GoalResponse::REJECT :
               rclcpp_action::GoalResponse::ACCEPT_AND_EXECUTE;
      },
      [](const std::shared_ptr<GoalHandle>) {return rclcpp_action::CancelResponse::ACCEPT;},
      [this](const std::shared_ptr<GoalHandle> handle) {accept(handle);});
    manager_.on_finished(
      [this](bool success, const std::string & reason) {finish_goal(success, reason);});
    timer_ = create_wall_timer(std::chrono::duration<double>(kPeriod_s), [this]() {on_timer();});
  }

private:
  PursuitSettings declared_pursuit()
  {
    PursuitSettings settings;
    settings.lookahead_m = declare_parameter<double>("lookahead_m", settings.lookahead_m);
    settings.cruise_m_s = declare_parameter<double>("cruise_m_s", settings.cruise_m_s);
    settings.turn_rad_s = declare_parameter<double>("turn_rad_s", settings.turn_rad_s);
    return settings;
  }

  SpeedLimits declared_limits()
  {
    SpeedLimits limits;
    limits.linear_m_s = declare_parameter<double>("max_linear_m_s", limits.linear_m_s);
    limits.angular_rad_s = declare_parameter<double>("max_angular_rad_s", limits.angular_rad_s);
    limits.stop_at_m = declare_parameter<double>("stop_at_m", limits.stop_at_m);
    return limits;
  }

  void subscribe()
  {
    odometry_subscription_ = create_subscription<nav_msgs::msg::Odometry>(
      "odom", 10, [this](const nav_msgs::msg::Odometry & message) {
        const auto & rotation = message.pose.pose.orientation;
        Pose pose;
        pose.place = {message.pose.pose.position.x, message.pose.pose.position.y};
        pose.heading = 2.0 * std::atan2(rotation.z, rotation.w);
        manager_.update_pose(pose);
        manager_.update_velocity({message.twist.twist.linear.x, message.twist.twist.angular.z});
      });
    scan_subscription_ = create_subscription<sensor_msgs::msg::LaserScan>(
      "scan", rclcpp::SensorDataQoS(), [this](const sensor_msgs::msg::LaserScan & message) {
        manager_.update_scan(message.ranges, message.angle_min, message.angle_increment);
      });
    battery_subscription_ = create_subscription<sensor_msgs::msg::BatteryState>(
      "battery", 10, [this](const sensor_msgs::msg::BatteryState & message) {
        manager_.update_battery(message.percentage);
      });
    motor_subscription_ = create_subscription<rover_msgs::msg::MotorStatus>(
      "motor_status", 10, [this](const rover_msgs::msg::MotorStatus & message) {
        manager_.update_wheels(message.left_rad_s, message.right_rad_s);
      });
  }

  static Mission mission_of(const std::vector<rover_msgs::msg::Waypoint> & messages, bool loop)
  {
    std::vector<Waypoint> waypoints;
    for (const auto & message : messages) {
      const bool stops = message.mode == rover_msgs::msg::Waypoint::STOP;
      waypoints.push_back(
        {message.name, {message.position.x, message.position.y}, message.tolerance_m,
          stops ? message.hold_s : 0.0});
    }
    return Mission(waypoints, loop);
  }

  void set_mission(const SetMission::Request & request, SetMission::Response & response)
  {
    if (request.frame_id != "odom") {
      response.accepted = false;
      response.reason = "missions are driven in odom, not in " + request.frame_id;
      return;
    }
    manager_.set_mission(mission_of(request.waypoints, false));
    response.accepted = true;
    RCLCPP_INFO(get_logger(), "mission with %zu waypoints", request.waypoints.size());
  }

  void accept(const std::shared_ptr<GoalHandle> & handle)
  {
    if (goal_) {
      finish_goal(false, "another mission came");
    }
    goal_ = handle;
    manager_.set_mission(mission_of(handle->get_goal()->waypoints, handle->get_goal()->loop));
  }

  void finish_goal(bool success, const std::string & reason)
  {
    if (!goal_) {
      return;
    }
    auto result = std::make_shared<FollowMission::Result>();
    result->reached = static_cast<std::uint32_t>(manager_.reached());
    result->reason = reason;
    if (success) {
      goal_->succeed(result);
    } else {
      goal_->abort(result);
    }
    goal_.reset();
  }

  void on_timer()
  {
    if (goal_ && goal_->is_canceling()) {
      auto result = std::make_shared<FollowMission::Result>();
      result->reached = static_cast<std::uint32_t>(manager_.reached());
      goal_->canceled(result);
      goal_.reset();
      manager_.stop();
    }
    const Velocity velocity = manager_.step(kPeriod_s);
    geometry_msgs::msg::Twist command;
    command.linear.x = velocity.linear;
    command.angular.z = velocity.angular;
    velocity_publisher_->publish(command);
    if (++ticks_ % 2 == 0) {
      publish_state();
    }
  }

  void publish_state()
  {
    rover_msgs::msg::RoverState message;
    message.header.stamp = now();
    message.state = static_cast<std::uint8_t>(manager_.state());
    message.waypoint = manager_.waypoint_name();
    message.remaining_m = static_cast<float>(manager_.remaining());
    message.battery = static_cast<float>(manager_.battery());
    state_publisher_->publish(message);
    if (goal_) {
      auto feedback = std::make_shared<FollowMission::Feedback>();
      feedback->next = static_cast<std::uint32_t>(manager_.next());
      feedback->remaining_m = message.remaining_m;
      goal_->publish_feedback(feedback);
    }
  }

  MissionManager manager_;
  std::size_t ticks_ = 0;
  std::shared_ptr<GoalHandle> goal_;
  rclcpp::Publisher<geometry_msgs::msg::Twist>::SharedPtr velocity_publisher_;
  rclcpp::Publisher<rover_msgs::msg::RoverState>::SharedPtr state_publisher_;
  rclcpp::Subscription<nav_msgs::msg::Odometry>::SharedPtr odometry_subscription_;
  rclcpp::Subscription<sensor_msgs::msg::LaserScan>::SharedPtr scan_subscription_;
  rclcpp::Subscription<sensor_msgs::msg::BatteryState>::SharedPtr battery_subscription_;
  rclcpp::Subscription<rover_msgs::msg::MotorStatus>::SharedPtr motor_subscription_;
  rclcpp::Service<SetMission>::SharedPtr mission_service_;
  rclcpp_action::Server<FollowMission>::SharedPtr mission_action_;
  rclcpp::TimerBase::SharedPtr timer_;
};

}  // namespace rover_navigation

int main(int argc, char ** argv)
{
  rclcpp::init(argc, argv);
  rclcpp::spin(std::make_shared<rover_navigation::FollowerNode>());
  rclcpp::shutdown();
  return 0;
}
