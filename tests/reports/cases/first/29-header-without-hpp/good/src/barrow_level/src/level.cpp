#include <memory>

#include "geometry_msgs/msg/quaternion.hpp"
#include "rclcpp/rclcpp.hpp"
#include "tf2/LinearMath/Quaternion.h"
#include "tf2_geometry_msgs/tf2_geometry_msgs.hpp"

class Level : public rclcpp::Node
{
public:
  Level()
  : Node("level")
  {
    tilt_ = create_subscription<geometry_msgs::msg::Quaternion>(
      "tilt", 10, [this](const geometry_msgs::msg::Quaternion & tilt) {tf2::fromMsg(tilt, last_);});
  }

private:
  tf2::Quaternion last_;
  rclcpp::Subscription<geometry_msgs::msg::Quaternion>::SharedPtr tilt_;
};

int main(int argc, char ** argv)
{
  rclcpp::init(argc, argv);
  rclcpp::spin(std::make_shared<Level>());
  rclcpp::shutdown();
  return 0;
}
