#include <memory>

#include "geometry_msgs/msg/pose_stamped.hpp"
#include "rclcpp/rclcpp.hpp"

struct Correction
{
  rclcpp::Time stamp{0, 0, RCL_ROS_TIME};
  double weight{0.0};
};

class Pose : public rclcpp::Node
{
public:
  Pose()
  : Node("pose")
  {
    fixes_ = create_subscription<geometry_msgs::msg::PoseStamped>(
      "fix", 10, [this](const geometry_msgs::msg::PoseStamped & fix) {on_fix(fix);});
  }

private:
  void on_fix(const geometry_msgs::msg::PoseStamped & fix)
  {
    if (now() - last_.stamp < rclcpp::Duration::from_seconds(1.0)) {
      return;
    }
    last_.stamp = fix.header.stamp;
    last_.weight = 1.0;
  }

  Correction last_;
  rclcpp::Subscription<geometry_msgs::msg::PoseStamped>::SharedPtr fixes_;
};

int main(int argc, char ** argv)
{
  rclcpp::init(argc, argv);
  rclcpp::spin(std::make_shared<Pose>());
  rclcpp::shutdown();
  return 0;
}
