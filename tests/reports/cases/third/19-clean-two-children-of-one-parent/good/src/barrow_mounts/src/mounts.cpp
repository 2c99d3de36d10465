#include <string>

#include <geometry_msgs/TransformStamped.h>
#include <ros/ros.h>
#include <tf2_ros/static_transform_broadcaster.h>

geometry_msgs::TransformStamped mount(const std::string & child, double y)
{
  geometry_msgs::TransformStamped transform;
  transform.header.stamp = ros::Time::now();
  transform.header.frame_id = "base_link";
  transform.child_frame_id = child;
  transform.transform.translation.y = y;
  transform.transform.rotation.w = 1.0;
  return transform;
}

int main(int argc, char ** argv)
{
  ros::init(argc, argv, "mounts");
  ros::NodeHandle nh;
  tf2_ros::StaticTransformBroadcaster broadcaster;
  broadcaster.sendTransform(mount("left_lamp", 0.3));
  broadcaster.sendTransform(mount("right_lamp", -0.3));
  ros::spin();
  return 0;
}
