#include <memory>

#include "rclcpp/rclcpp.hpp"
#include "std_msgs/msg/bool.hpp"

class Horn : public rclcpp::Node
{
public:
  Horn()
  : Node("horn")
  {
    blow_ = create_subscription<std_msgs::msg::Bool>(
      "blow", 10, [this](const std_msgs::msg::Bool & on) {on_ = on.data;});
  }

private:
  bool on_{false};
  rclcpp::Subscription<std_msgs::msg::Bool>::SharedPtr blow_;
};

int main(int argc, char ** argv)
{
  rclcpp::init(argc, argv);
  rclcpp::executors::SingleThreadedExecutor executor;
  executor.add_node(std::make_shared<Horn>());
  executor.spin();
  rclcpp::shutdown();
  return 0;
}
