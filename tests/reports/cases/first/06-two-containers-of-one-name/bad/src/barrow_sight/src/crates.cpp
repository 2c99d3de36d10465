#include <chrono>

#include "rclcpp/rclcpp.hpp"
#include "rclcpp_components/register_node_macro.hpp"
#include "std_msgs/msg/u_int32.hpp"

namespace barrow_sight
{
class Crates : public rclcpp::Node
{
public:
  explicit Crates(const rclcpp::NodeOptions & options)
  : Node("crates", options)
  {
    count_ = create_publisher<std_msgs::msg::UInt32>("crates/count", 10);
    timer_ = create_wall_timer(std::chrono::seconds(1), [this]() {count_->publish(std_msgs::msg::UInt32());});
  }

private:
  rclcpp::Publisher<std_msgs::msg::UInt32>::SharedPtr count_;
  rclcpp::TimerBase::SharedPtr timer_;
};
}  // namespace barrow_sight

RCLCPP_COMPONENTS_REGISTER_NODE(barrow_sight::Crates)
