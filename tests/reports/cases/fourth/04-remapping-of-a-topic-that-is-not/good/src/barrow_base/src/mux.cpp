#include <geometry_msgs/Twist.h>
#include <ros/ros.h>

ros::Publisher output;

void onCommand(const geometry_msgs::Twist::ConstPtr & command)
{
  output.publish(command);
}

int main(int argc, char ** argv)
{
  ros::init(argc, argv, "mux");
  ros::NodeHandle own("~");
  output = own.advertise<geometry_msgs::Twist>("output", 10);
  ros::Subscriber input = own.subscribe("input", 10, &onCommand);
  ros::spin();
  return 0;
}
