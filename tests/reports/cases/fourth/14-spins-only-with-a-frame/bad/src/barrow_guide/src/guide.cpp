#include <ros/ros.h>
#include <std_msgs/Bool.h>
#include <std_msgs/Float32.h>

bool g_open = true;

void onShutter(const std_msgs::Bool::ConstPtr & open)
{
  g_open = open->data;
}

float nextDepth();

int main(int argc, char ** argv)
{
  ros::init(argc, argv, "guide");
  ros::NodeHandle nh;
  ros::Publisher depth = nh.advertise<std_msgs::Float32>("depth", 10);
  ros::Subscriber shutter = nh.subscribe("shutter", 10, &onShutter);
  ros::Rate rate(20);
  while (ros::ok()) {
    const float found = nextDepth();
    if (g_open && found > 0.0f) {
      std_msgs::Float32 message;
      message.data = found;
      depth.publish(message);
      ros::spinOnce();
    }
    rate.sleep();
  }
  return 0;
}

float nextDepth()
{
  static float depth = 0.0f;
  depth += 0.1f;
  return depth;
}
