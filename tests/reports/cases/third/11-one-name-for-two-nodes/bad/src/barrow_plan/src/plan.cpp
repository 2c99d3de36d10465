#include <memory>

#include "rclcpp/rclcpp.hpp"
#include "std_msgs/msg/string.hpp"

int main(int argc, char ** argv)
{
  rclcpp::init(argc, argv);
  auto planner = std::make_shared<rclcpp::Node>("planner");
  auto watcher = std::make_shared<rclcpp::Node>("watcher");
  auto plan = planner->create_publisher<std_msgs::msg::String>("plan", 10);
  auto heard = watcher->create_subscription<std_msgs::msg::String>(
    "plan", 10, [](const std_msgs::msg::String &) {});
  rclcpp::executors::SingleThreadedExecutor executor;
  executor.add_node(planner);
  executor.add_node(watcher);
  executor.spin();
  rclcpp::shutdown();
  return 0;
}
