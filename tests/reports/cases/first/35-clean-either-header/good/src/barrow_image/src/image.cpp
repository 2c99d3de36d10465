#include <memory>

#if __has_include(<cv_bridge/cv_bridge.hpp>)
#include <cv_bridge/cv_bridge.hpp>
#else
#include <cv_bridge/cv_bridge.h>
#endif
#include <rclcpp/rclcpp.hpp>
#include <sensor_msgs/msg/image.hpp>

class Image : public rclcpp::Node
{
public:
  Image()
  : Node("image")
  {
    images_ = create_subscription<sensor_msgs::msg::Image>(
      "image", rclcpp::SensorDataQoS(), [this](sensor_msgs::msg::Image::ConstSharedPtr image) {
        rows_ = cv_bridge::toCvShare(image, "mono8")->image.rows;
      });
  }

private:
  int rows_{0};
  rclcpp::Subscription<sensor_msgs::msg::Image>::SharedPtr images_;
};

int main(int argc, char ** argv)
{
  rclcpp::init(argc, argv);
  rclcpp::spin(std::make_shared<Image>());
  rclcpp::shutdown();
  return 0;
}
