#include <memory>

#include "rclcpp/rclcpp.hpp"
#include "std_msgs/msg/bool.hpp"

class Horn : public rclcpp::Node
{
public:
  Horn()
  : Node("horn")
  {
    auto group = create_callback_group(rclcpp::CallbackGroupType::MutuallyExclusive);
    rclcpp::SubscriptionOptions options;
    options.callback_group = group;
    blow_ = create_subscription<std_msgs::msg::Bool>(
      "blow", 10, [this](const std_msgs::msg::Bool & on) {on_ = on.data;}, options);
  }

private:
  bool on_{false};
  rclcpp::Subscription<std_msgs::msg::Bool>::SharedPtr blow_;
};

int main(int argc, char ** argv)
{
  rclcpp::init(argc, argv);
  rclcpp::executors::MultiThreadedExecutor executor;
  auto horn = std::make_shared<Horn>();
  executor.add_node(horn);
  executor.spin();
  rclcpp::shutdown();
  return 0;
}
