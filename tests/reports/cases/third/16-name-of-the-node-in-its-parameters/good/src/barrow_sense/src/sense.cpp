#include <string>

#include <ros/ros.h>
#include <sensor_msgs/Imu.h>

int main(int argc, char ** argv)
{
  ros::init(argc, argv, "sense");
  ros::NodeHandle nh;
  ros::NodeHandle own("~");
  std::string frame_id = "imu_link";
  own.getParam("frame_id", frame_id);
  ros::Publisher out = nh.advertise<sensor_msgs::Imu>("imu", 10);
  ros::Rate rate(50);
  while (ros::ok()) {
    sensor_msgs::Imu imu;
    imu.header.stamp = ros::Time::now();
    imu.header.frame_id = frame_id;
    imu.orientation.w = 1.0;
    out.publish(imu);
    ros::spinOnce();
    rate.sleep();
  }
  return 0;
}
