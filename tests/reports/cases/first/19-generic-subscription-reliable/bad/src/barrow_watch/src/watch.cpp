#include <memory>
#include <string>

#include "rclcpp/rclcpp.hpp"

class Watch : public rclcpp::Node
{
public:
  Watch()
  : Node("watch")
  {
    cloud_ = create_generic_subscription(
      "points", "sensor_msgs/msg/PointCloud2", rclcpp::QoS(10),
      [this](std::shared_ptr<rclcpp::SerializedMessage> message) {bytes_ += message->size();});
  }

private:
  std::size_t bytes_{0};
  rclcpp::GenericSubscription::SharedPtr cloud_;
};

int main(int argc, char ** argv)
{
  rclcpp::init(argc, argv);
  rclcpp::spin(std::make_shared<Watch>());
  rclcpp::shutdown();
  return 0;
}
