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

#include "geometry_msgs/msg/transform_stamped.hpp"
#include "geometry_msgs/msg/twist.hpp"
#include "nav_msgs/msg/odometry.hpp"
#include "rclcpp/rclcpp.hpp"
#include "rover_base/motor_board.hpp"
#include "rover_base/odometry.hpp"
#include "rover_base/serial_port.hpp"
#include "rover_msgs/msg/motor_status.hpp"
#include "tf2_ros/transform_broadcaster.h"

namespace rover_base
{

using namespace std::chrono_literals;

/// Passes velocity commands on to the motor board and publishes what it reports.
class BaseNode : public rclcpp::Node
{
public:
  BaseNode()
  : Node("rover_base"), odometry_(declared_geometry()), transforms_(*this)
  {
    device_ = declare_parameter<std::string>("device", "/dev/ttyUSB0");
    baud_ = static_cast<int>(declare_parameter<int>("baud", 115200));
    patience_ = rclcpp::Duration::from_seconds(declare_parameter<double>("command_timeout_s", 0.5));
    odometry_publisher_ = create_publisher<nav_msgs::msg::Odometry>("odom", 10);
    status_publisher_ = create_publisher<rover_msgs::msg::MotorStatus>("motor_status", 10);
    command_subscription_ = create_subscription<geometry_msgs::msg::Twist>(
      "cmd_vel", rclcpp::SystemDefaultsQoS(),
      [this](const geometry_msgs::msg::Twist & message) {on_command(message);});
    last_update_ = last_command_ = now();
    timer_ = create_wall_timer(20ms, [this]() {on_timer();});
  }

private:
  DriveGeometry declared_geometry()
  {
    DriveGeometry geometry;
    geometry.wheel_radius_m = declare_parameter<double>("wheel_radius_m", geometry.wheel_radius_m);
    geometry.track_m = declare_parameter<double>("track_m", geometry.track_m);
    return geometry;
  }

  void on_command(const geometry_msgs::msg::Twist & message)
  {
    wanted_.linear_m_s = message.linear.x;
    wanted_.angular_rad_s = message.angular.z;
    last_command_ = now();
  }

  void on_timer()
  {
    if (!port_.is_open() && !port_.open(device_, baud_)) {
      RCLCPP_WARN_THROTTLE(
        get_logger(), *get_clock(), 5000, "cannot open %s, trying again", device_.c_str());
      return;
    }
    if (const auto report = board_.feed(port_.read())) {
      publish(*report);
    }
    send_command();
  }

  // A command that is too old stops the rover: whoever sent it may be gone.
  void send_command()
  {
    const bool fresh = now() - last_command_ < patience_;
    const Twist twist = fresh ? wanted_ : Twist();
    MotorCommand command;
    command.left_rad_s = odometry_.left_of(twist);
    command.right_rad_s = odometry_.right_of(twist);
    if (!port_.write(board_.frame(command))) {
      RCLCPP_ERROR(get_logger(), "lost %s", device_.c_str());
      port_.close();
    }
  }

  void publish(const MotorReport & report)
  {
    const rclcpp::Time stamp = now();
    odometry_.update(report.left_rad_s, report.right_rad_s, (stamp - last_update_).seconds());
    last_update_ = stamp;
    publish_odometry(stamp);

    rover_msgs::msg::MotorStatus status;
    status.header.stamp = stamp;
    status.left_rad_s = static_cast<float>(report.left_rad_s);
    status.right_rad_s = static_cast<float>(report.right_rad_s);
    status.current_a = static_cast<float>(report.current_a);
    status.voltage_v = static_cast<float>(report.voltage_v);
    status.faults = report.faults;
    status_publisher_->publish(status);
  }

  void publish_odometry(const rclcpp::Time & stamp)
  {
    const Pose & pose = odometry_.pose();
    nav_msgs::msg::Odometry message;
    message.header.stamp = stamp;
    message.header.frame_id = "odom";
    message.child_frame_id = "base_link";
    message.pose.pose.position.x = pose.x_m;
    message.pose.pose.position.y = pose.y_m;
    message.pose.pose.orientation.z = std::sin(pose.heading_rad / 2.0);
    message.pose.pose.orientation.w = std::cos(pose.heading_rad / 2.0);
    message.twist.twist.linear.x = odometry_.twist().linear_m_s;
    message.twist.twist.angular.z = odometry_.twist().angular_rad_s;
    odometry_publisher_->publish(message);

    geometry_msgs::msg::TransformStamped transform;
    transform.header = message.header;
    transform.child_frame_id = message.child_frame_id;
    transform.transform.translation.x = pose.x_m;
    transform.transform.translation.y = pose.y_m;
    transform.transform.rotation = message.pose.pose.orientation;
    transforms_.sendTransform(transform);
  }

  SerialPort port_;
  MotorBoard board_;
  Odometry odometry_;
  Twist wanted_;
  std::string device_;
  int baud_ = 0;
  rclcpp::Duration patience_{0, 0};
  rclcpp::Time last_update_;
  rclcpp::Time last_command_;
  tf2_ros::TransformBroadcaster transforms_;
  rclcpp::Publisher<nav_msgs::msg::Odometry>::SharedPtr odometry_publisher_;
  rclcpp::Publisher<rover_msgs::msg::MotorStatus>::SharedPtr status_publisher_;
  rclcpp::Subscription<geometry_msgs::msg::Twist>::SharedPtr command_subscription_;
  rclcpp::TimerBase::SharedPtr timer_;
};

}  // namespace rover_base

int main(int argc, char ** argv)
{
  rclcpp::init(argc, argv);
  rclcpp::spin(std::make_shared<rover_base::BaseNode>());
  rclcpp::shutdown();
  return 0;
}
