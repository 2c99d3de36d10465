#include <chrono>
#include <memory>

#include "rclcpp/rclcpp.hpp"
#include "sensor_msgs/msg/camera_info.hpp"

class Lens : public rclcpp::Node
{
public:
  Lens()
  : Node("lens")
  {
    width_ = declare_parameter<int>("width", 640);
    height_ = declare_parameter<int>("height", 480);
    info_ = create_publisher<sensor_msgs::msg::CameraInfo>("camera_info", 10);
    timer_ = create_wall_timer(std::chrono::milliseconds(100), [this]() {
      sensor_msgs::msg::CameraInfo info;
      info.header.stamp = now();
      info.header.frame_id = "lens";
      info.width = static_cast<unsigned>(width_);
      info.height = static_cast<unsigned>(height_);
      info_->publish(info);
    });
  }

private:
  int width_{0};
  int height_{0};
  rclcpp::Publisher<sensor_msgs::msg::CameraInfo>::SharedPtr info_;
  rclcpp::TimerBase::SharedPtr timer_;
};

int main(int argc, char ** argv)
{
  rclcpp::init(argc, argv);
  rclcpp::spin(std::make_shared<Lens>());
  rclcpp::shutdown();
  return 0;
}
