#include <chrono>
#include <memory>

#include "rclcpp/rclcpp.hpp"
#include "std_msgs/msg/float64.hpp"

class Wheel : public rclcpp::Node
{
public:
  Wheel()
  : Node("wheel")
  {
    const double loop_rate = declare_parameter<double>("loop_rate", 10.0);
    force_ = create_publisher<std_msgs::msg::Float64>("force", 10);
    timer_ = create_wall_timer(std::chrono::duration<double>(1.0 / loop_rate), [this]() {
      std_msgs::msg::Float64 force;
      force.data = 0.5;
      force_->publish(force);
    });
  }

private:
  rclcpp::Publisher<std_msgs::msg::Float64>::SharedPtr force_;
  rclcpp::TimerBase::SharedPtr timer_;
};

int main(int argc, char ** argv)
{
  rclcpp::init(argc, argv);
  rclcpp::spin(std::make_shared<Wheel>());
  rclcpp::shutdown();
  return 0;
}
