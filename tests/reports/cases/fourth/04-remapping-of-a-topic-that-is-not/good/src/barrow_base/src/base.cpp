#include <geometry_msgs/Twist.h>
#include <ros/ros.h>

void onCommand(const geometry_msgs::Twist::ConstPtr & command)
{
  ROS_INFO_ONCE("driving with %f", command->linear.x);
}

int main(int argc, char ** argv)
{
  ros::init(argc, argv, "base");
  ros::NodeHandle own("~");
  ros::Subscriber commands = own.subscribe("commands", 10, &onCommand);
  ros::spin();
  return 0;
}
