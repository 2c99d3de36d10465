#include <barrow_base/wheel.h>
#include <ros/ros.h>
#include <std_msgs/Float64.h>

int main(int argc, char** argv)
{
  ros::init(argc, argv, "turn");
  ros::NodeHandle nh;
  ros::Publisher turns = nh.advertise<std_msgs::Float64>("turns_per_metre", 1, true);
  std_msgs::Float64 turn;
  turn.data = 1.0 / (2.0 * 3.14159 * barrow_base::kWheelRadius);
  turns.publish(turn);
  ros::spin();
  return 0;
}
