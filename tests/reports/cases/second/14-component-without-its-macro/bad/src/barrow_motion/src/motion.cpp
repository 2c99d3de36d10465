#include <chrono>

#include "rclcpp/rclcpp.hpp"
#include "rclcpp_components/register_node_macro.hpp"
#include "std_msgs/msg/u_int32.hpp"

namespace barrow_motion
{
class Motion : public rclcpp::Node
{
public:
  explicit Motion(const rclcpp::NodeOptions & options)
  : Node("motion", options)
  {
    count_ = create_publisher<std_msgs::msg::UInt32>("motion/count", 10);
    timer_ = create_wall_timer(std::chrono::seconds(1), [this]() {count_->publish(std_msgs::msg::UInt32());});
  }

private:
  rclcpp::Publisher<std_msgs::msg::UInt32>::SharedPtr count_;
  rclcpp::TimerBase::SharedPtr timer_;
};
}  // namespace barrow_motion
