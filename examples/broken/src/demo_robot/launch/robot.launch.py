"""Starts the robot. Each argument breaks it where it has another value than here."""

from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node


def generate_launch_description():
    return LaunchDescription(
        [
            DeclareLaunchArgument("reliable", default_value="false"),
            DeclareLaunchArgument("cmd_vel", default_value="cmd_vel"),
            DeclareLaunchArgument("use_sim_time", default_value="false"),
            Node(package="demo_robot", executable="lidar"),
            Node(
                package="demo_robot",
                executable="odometry",
                parameters=[{"use_sim_time": LaunchConfiguration("use_sim_time")}],
            ),
            Node(
                package="demo_robot",
                executable="planner",
                parameters=[{"reliable": LaunchConfiguration("reliable")}],
                remappings=[("cmd_vel", LaunchConfiguration("cmd_vel"))],
            ),
        ]
    )
