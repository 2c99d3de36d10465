#include <chrono>
#include <memory>

#include "rclcpp/rclcpp.hpp"
#include "sensor_msgs/msg/imu.hpp"

class Imu : public rclcpp::Node
{
public:
  Imu()
  : Node("imu")
  {
    declare_parameter<double>("cc_gain");
    gain_ = get_parameter("cc_gain").as_double();
    imu_ = create_publisher<sensor_msgs::msg::Imu>("imu", 10);
    timer_ = create_wall_timer(std::chrono::milliseconds(50), [this]() {
      sensor_msgs::msg::Imu imu;
      imu.header.stamp = now();
      imu.header.frame_id = "imu";
      imu.angular_velocity.z *= gain_;
      imu_->publish(imu);
    });
  }

private:
  double gain_{0.0};
  rclcpp::Publisher<sensor_msgs::msg::Imu>::SharedPtr imu_;
  rclcpp::TimerBase::SharedPtr timer_;
};

int main(int argc, char ** argv)
{
  rclcpp::init(argc, argv);
  rclcpp::spin(std::make_shared<Imu>());
  rclcpp::shutdown();
  return 0;
}
