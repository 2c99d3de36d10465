#include <memory>

#include "barrow_arm/arm_parameters.hpp"
#include "rclcpp/rclcpp.hpp"

int main(int argc, char ** argv)
{
  rclcpp::init(argc, argv);
  auto node = std::make_shared<rclcpp::Node>("arm");
  auto listener = std::make_shared<arm::ParamListener>(node);
  RCLCPP_INFO(node->get_logger(), "nearest %f", listener->get_params().nearest);
  rclcpp::spin(node);
  rclcpp::shutdown();
  return 0;
}
