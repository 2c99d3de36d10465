// Stops the rover when its battery is low or something is close: the change that `make demo` looks at.

#include <algorithm>
#include <chrono>
#include <iostream>
#include <memory>
#include <thread>

#include <geometry_msgs/msg/twist.hpp>
#include <rclcpp/rclcpp.hpp>
#include <sensor_msgs/msg/battery_state.hpp>
#include <sensor_msgs/msg/laser_scan.hpp>

namespace rover_base {

class BatteryGuard : public rclcpp::Node {
 public:
  BatteryGuard() : Node("battery_guard") {
    battery_ = create_subscription<sensor_msgs::msg::BatteryState>(
        "battery", 10, [this](const sensor_msgs::msg::BatteryState& state) { on_battery(state); });
    scan_ = create_subscription<sensor_msgs::msg::LaserScan>(
        "scan", 10, [this](const sensor_msgs::msg::LaserScan& scan) { on_scan(scan); });
  }

 private:
  // Brakes, waits until the rover stands, and says so.
  void on_battery(const sensor_msgs::msg::BatteryState& state) {
    auto brake = create_publisher<geometry_msgs::msg::Twist>("cmd_vel", 10);
    if (state.percentage < 0.1 || closest_ < 0.3F) {
      brake->publish(geometry_msgs::msg::Twist());
      std::this_thread::sleep_for(std::chrono::seconds(2));
      std::cout << "battery low, stopped" << std::endl;
    }
  }

  void on_scan(const sensor_msgs::msg::LaserScan& scan) {
    closest_ = scan.ranges.empty() ? scan.range_max : *std::min_element(scan.ranges.begin(), scan.ranges.end());
  }

  float closest_ = 100.0F;
  rclcpp::Subscription<sensor_msgs::msg::BatteryState>::SharedPtr battery_;
  rclcpp::Subscription<sensor_msgs::msg::LaserScan>::SharedPtr scan_;
};

}  // namespace rover_base

int main(int argc, char** argv) {
  rclcpp::init(argc, argv);
  rclcpp::spin(std::make_shared<rover_base::BatteryGuard>());
  rclcpp::shutdown();
  return 0;
}
