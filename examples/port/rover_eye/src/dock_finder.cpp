#include <cv_bridge/cv_bridge.h>
#include <tf2_geometry_msgs/tf2_geometry_msgs.h>

#include <geometry_msgs/msg/pose_stamped.hpp>
#include <image_transport/image_transport.hpp>
#include <memory>
#include <rclcpp/rclcpp.hpp>
#include <sensor_msgs/msg/image.hpp>

class DockFinder : public rclcpp::Node
{
public:
  DockFinder()
  : Node("dock_finder")
  {
    docks_ = create_publisher<geometry_msgs::msg::PoseStamped>("dock", 10);
    images_ = create_subscription<sensor_msgs::msg::Image>(
      "image", rclcpp::SensorDataQoS(), [this](sensor_msgs::msg::Image::ConstSharedPtr image) { look(image); });
  }

private:
  void look(const sensor_msgs::msg::Image::ConstSharedPtr & image)
  {
    const auto grey = cv_bridge::toCvShare(image, "mono8");
    geometry_msgs::msg::PoseStamped dock;
    dock.header = image->header;
    dock.pose.position.x = grey->image.cols;
    docks_->publish(dock);
  }

  rclcpp::Publisher<geometry_msgs::msg::PoseStamped>::SharedPtr docks_;
  rclcpp::Subscription<sensor_msgs::msg::Image>::SharedPtr images_;
};

int main(int argc, char ** argv)
{
  rclcpp::init(argc, argv);
  rclcpp::spin(std::make_shared<DockFinder>());
  rclcpp::shutdown();
  return 0;
}
