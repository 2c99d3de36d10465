#include <memory>

#include "rclcpp/rclcpp.hpp"
#include "rcutils/logging_macros.h"

int main(int argc, char ** argv)
{
  rclcpp::init(argc, argv);
  auto node = std::make_shared<rclcpp::Node>("mocap");
  RCUTILS_LOG_INFO("waiting for the cameras");
  rclcpp::spin(node);
  rclcpp::shutdown();
  return 0;
}
