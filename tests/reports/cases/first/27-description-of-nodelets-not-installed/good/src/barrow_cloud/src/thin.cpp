#include <nodelet/nodelet.h>
#include <pluginlib/class_list_macros.hpp>
#include <ros/ros.h>
#include <sensor_msgs/PointCloud2.h>

namespace barrow_cloud
{
class Thin : public nodelet::Nodelet
{
  void onInit() override
  {
    out_ = getNodeHandle().advertise<sensor_msgs::PointCloud2>("thin_points", 5);
    in_ = getNodeHandle().subscribe("points", 5, &Thin::onCloud, this);
  }

  void onCloud(const sensor_msgs::PointCloud2ConstPtr& cloud)
  {
    if (++count_ % 4 == 0)
      out_.publish(cloud);
  }

  unsigned count_{0};
  ros::Publisher out_;
  ros::Subscriber in_;
};
}  // namespace barrow_cloud

PLUGINLIB_EXPORT_CLASS(barrow_cloud::Thin, nodelet::Nodelet)
