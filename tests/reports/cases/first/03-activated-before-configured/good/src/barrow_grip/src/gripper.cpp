#include <memory>

#include "rclcpp/rclcpp.hpp"
#include "rclcpp_lifecycle/lifecycle_node.hpp"
#include "std_msgs/msg/float32.hpp"

using CallbackReturn = rclcpp_lifecycle::node_interfaces::LifecycleNodeInterface::CallbackReturn;

class Gripper : public rclcpp_lifecycle::LifecycleNode
{
public:
  Gripper()
  : LifecycleNode("gripper") {}

  CallbackReturn on_configure(const rclcpp_lifecycle::State &) override
  {
    width_ = create_publisher<std_msgs::msg::Float32>("width", 10);
    return CallbackReturn::SUCCESS;
  }

private:
  rclcpp_lifecycle::LifecyclePublisher<std_msgs::msg::Float32>::SharedPtr width_;
};

int main(int argc, char ** argv)
{
  rclcpp::init(argc, argv);
  auto node = std::make_shared<Gripper>();
  rclcpp::spin(node->get_node_base_interface());
  rclcpp::shutdown();
  return 0;
}
