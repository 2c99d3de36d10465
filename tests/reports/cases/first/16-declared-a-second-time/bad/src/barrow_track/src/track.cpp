#include <memory>

#include "geometry_msgs/msg/pose_stamped.hpp"
#include "rclcpp/rclcpp.hpp"

int main(int argc, char ** argv)
{
  rclcpp::init(argc, argv);
  rclcpp::NodeOptions options;
  options.automatically_declare_parameters_from_overrides(true);
  auto node = std::make_shared<rclcpp::Node>("track", options);
  bool save = false;
  node->declare_parameter<bool>("save_track", false);
  node->get_parameter("save_track", save);
  auto poses = node->create_subscription<geometry_msgs::msg::PoseStamped>(
    "pose", 10, [node, save](const geometry_msgs::msg::PoseStamped & pose) {
      if (save) {
        RCLCPP_INFO(node->get_logger(), "x %f", pose.pose.position.x);
      }
    });
  rclcpp::spin(node);
  rclcpp::shutdown();
  return 0;
}
