#include <chrono>
#include <memory>

#include "rclcpp/rclcpp.hpp"
#include "std_msgs/msg/string.hpp"

class Late : public rclcpp::Node
{
public:
  Late()
  : Node("late")
  {
    timer_ = create_wall_timer(std::chrono::seconds(1), [this]() {start();});
  }

private:
  void start()
  {
    timer_->cancel();
    heard_ = create_subscription<std_msgs::msg::String>(
      "crates", 10, [this](const std_msgs::msg::String & crate) {
        RCLCPP_INFO(get_logger(), "crate %s", crate.data.c_str());
      });
  }

  rclcpp::TimerBase::SharedPtr timer_;
  rclcpp::Subscription<std_msgs::msg::String>::SharedPtr heard_;
};

int main(int argc, char ** argv)
{
  rclcpp::init(argc, argv);
  rclcpp::spin(std::make_shared<Late>());
  rclcpp::shutdown();
  return 0;
}
