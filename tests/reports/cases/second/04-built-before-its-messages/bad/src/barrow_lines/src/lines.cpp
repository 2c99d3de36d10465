#include <barrow_lines/Line.h>
#include <ros/ros.h>

int main(int argc, char** argv)
{
  ros::init(argc, argv, "lines");
  ros::NodeHandle nh;
  ros::Publisher lines = nh.advertise<barrow_lines::Line>("lines", 10);
  ros::Rate rate(10);
  while (ros::ok())
  {
    barrow_lines::Line line;
    line.header.stamp = ros::Time::now();
    line.header.frame_id = "laser";
    lines.publish(line);
    rate.sleep();
  }
  return 0;
}
