#include <chrono>
#include <memory>

#include "rclcpp/rclcpp.hpp"
#include "sensor_msgs/msg/point_cloud2.hpp"

class Scanner : public rclcpp::Node
{
public:
  Scanner()
  : Node("scanner")
  {
    points_ = create_publisher<sensor_msgs::msg::PointCloud2>("points", rclcpp::SensorDataQoS());
    timer_ = create_wall_timer(std::chrono::milliseconds(100), [this]() {
      sensor_msgs::msg::PointCloud2 points;
      points.header.stamp = now();
      points.header.frame_id = "scanner";
      points_->publish(points);
    });
  }

private:
  rclcpp::Publisher<sensor_msgs::msg::PointCloud2>::SharedPtr points_;
  rclcpp::TimerBase::SharedPtr timer_;
};

int main(int argc, char ** argv)
{
  rclcpp::init(argc, argv);
  rclcpp::spin(std::make_shared<Scanner>());
  rclcpp::shutdown();
  return 0;
}
