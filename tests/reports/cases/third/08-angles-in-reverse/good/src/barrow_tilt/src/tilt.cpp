#include <cmath>

#include <geometry_msgs/Vector3Stamped.h>
#include <ros/ros.h>
#include <sensor_msgs/Imu.h>
#include <tf2/LinearMath/Quaternion.h>
#include <tf2_geometry_msgs/tf2_geometry_msgs.h>

class Tilt
{
public:
  explicit Tilt(ros::NodeHandle & nh)
  {
    imu_ = nh.advertise<sensor_msgs::Imu>("imu", 10);
    angles_ = nh.subscribe("angles", 10, &Tilt::onAngles, this);
  }

private:
  void onAngles(const geometry_msgs::Vector3Stamped::ConstPtr & angles)
  {
    const double rad = M_PI / 180.0;
    tf2::Quaternion q;
    q.setRPY(angles->vector.x * rad, angles->vector.y * rad, angles->vector.z * rad);
    sensor_msgs::Imu imu;
    imu.header = angles->header;
    imu.orientation = tf2::toMsg(q);
    imu_.publish(imu);
  }

  ros::Publisher imu_;
  ros::Subscriber angles_;
};

int main(int argc, char ** argv)
{
  ros::init(argc, argv, "tilt");
  ros::NodeHandle nh;
  Tilt tilt(nh);
  ros::spin();
  return 0;
}
