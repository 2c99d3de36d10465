#include <chrono>
#include <memory>

#include "rclcpp/rclcpp.hpp"
#include "std_msgs/msg/bool.hpp"

class Tick : public rclcpp::Node
{
public:
  Tick()
  : Node("tick")
  {
    group_ = create_callback_group(rclcpp::CallbackGroupType::MutuallyExclusive);
    alive_ = create_publisher<std_msgs::msg::Bool>("alive", 10);
    timer_ = create_wall_timer(std::chrono::seconds(1), [this]() {on_timer();}, group_);
  }

private:
  void on_timer()
  {
    std_msgs::msg::Bool alive;
    alive.data = true;
    alive_->publish(alive);
  }

  rclcpp::Publisher<std_msgs::msg::Bool>::SharedPtr alive_;
  rclcpp::CallbackGroup::SharedPtr group_;
  rclcpp::TimerBase::SharedPtr timer_;
};

int main(int argc, char ** argv)
{
  rclcpp::init(argc, argv);
  rclcpp::executors::MultiThreadedExecutor executor;
  auto tick = std::make_shared<Tick>();
  executor.add_node(tick);
  executor.spin();
  rclcpp::shutdown();
  return 0;
}
