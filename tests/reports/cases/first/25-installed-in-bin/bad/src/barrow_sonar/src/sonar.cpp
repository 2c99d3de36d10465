#include <chrono>
#include <memory>

#include "rclcpp/rclcpp.hpp"
#include "sensor_msgs/msg/range.hpp"

class Sonar : public rclcpp::Node
{
public:
  Sonar()
  : Node("sonar")
  {
    longest_ = declare_parameter<double>("longest_range", 4.0);
    range_ = create_publisher<sensor_msgs::msg::Range>("range", 10);
    timer_ = create_wall_timer(std::chrono::milliseconds(50), [this]() {
      sensor_msgs::msg::Range range;
      range.header.stamp = now();
      range.header.frame_id = "sonar";
      range.max_range = static_cast<float>(longest_);
      range_->publish(range);
    });
  }

private:
  double longest_{0.0};
  rclcpp::Publisher<sensor_msgs::msg::Range>::SharedPtr range_;
  rclcpp::TimerBase::SharedPtr timer_;
};

int main(int argc, char ** argv)
{
  rclcpp::init(argc, argv);
  rclcpp::spin(std::make_shared<Sonar>());
  rclcpp::shutdown();
  return 0;
}
