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

#include <cstddef>

#include <boost/bind/bind.hpp>

#include <dynamic_reconfigure/server.h>
#include <geometry_msgs/Twist.h>
#include <ros/ros.h>
#include <sensor_msgs/Joy.h>

#include "rover_teleop/TeleopConfig.h"
#include "rover_teleop/joystick_profile.h"

namespace rover_teleop
{

/// Sends velocities while the dead man's button is held, and one stop when it is let go.
class JoystickTeleop
{
public:
  JoystickTeleop(ros::NodeHandle& node, ros::NodeHandle& own)
    : profile_(own.param("dead_zone", 0.08), own.param("exponent", 1.7))
    , linear_axis_(own.param("linear_axis", 1))
    , angular_axis_(own.param("angular_axis", 0))
    , server_(own)
  {
    publisher_ = node.advertise<geometry_msgs::Twist>("cmd_vel", 1);
    subscriber_ = node.subscribe("joy", 1, &JoystickTeleop::onJoy, this);
    timer_ = node.createTimer(ros::Duration(0.1), &JoystickTeleop::onTimer, this);
    server_.setCallback(boost::bind(&JoystickTeleop::onConfig, this, boost::placeholders::_1));
  }

private:
  void onConfig(const TeleopConfig& config)
  {
    config_ = config;
  }

  void onJoy(const sensor_msgs::Joy::ConstPtr& message)
  {
    last_joy_ = ros::Time::now();
    const bool held = pressed(*message, config_.deadman_button);
    if (!held && driving_)
    {
      stop();
      return;
    }
    driving_ = held;
    command_.linear.x = config_.max_linear * profile_.shaped(axis(*message, linear_axis_));
    command_.angular.z = config_.max_angular * profile_.shaped(axis(*message, angular_axis_));
  }

  // Repeats the command, since a stick that is held still sends nothing; stops when the joystick is gone.
  void onTimer(const ros::TimerEvent&)
  {
    if (!driving_)
    {
      return;
    }
    if (ros::Time::now() - last_joy_ > ros::Duration(1.0))
    {
      ROS_WARN("the joystick is silent, stopping");
      stop();
      return;
    }
    publisher_.publish(command_);
  }

  void stop()
  {
    driving_ = false;
    publisher_.publish(geometry_msgs::Twist());
  }

  static bool pressed(const sensor_msgs::Joy& message, int button)
  {
    return button >= 0 && static_cast<std::size_t>(button) < message.buttons.size() && message.buttons[button] != 0;
  }

  static double axis(const sensor_msgs::Joy& message, int axis)
  {
    return axis >= 0 && static_cast<std::size_t>(axis) < message.axes.size() ? message.axes[axis] : 0.0;
  }

  JoystickProfile profile_;
  int linear_axis_;
  int angular_axis_;
  bool driving_ = false;
  ros::Time last_joy_;
  TeleopConfig config_;
  geometry_msgs::Twist command_;
  ros::Publisher publisher_;
  ros::Subscriber subscriber_;
  ros::Timer timer_;
  dynamic_reconfigure::Server<TeleopConfig> server_;
};

}  // namespace rover_teleop

int main(int argc, char** argv)
{
  ros::init(argc, argv, "joystick_teleop");
  ros::NodeHandle node;
  ros::NodeHandle own("~");
  rover_teleop::JoystickTeleop teleop(node, own);
  ros::spin();
  return 0;
}
