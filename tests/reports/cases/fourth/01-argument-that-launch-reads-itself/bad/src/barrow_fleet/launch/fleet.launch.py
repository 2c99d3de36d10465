from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node


def generate_launch_description():
    return LaunchDescription([
        DeclareLaunchArgument('ros_namespace', default_value='crate', description='Where the robot lives.'),
        Node(
            package='demo_nodes_cpp',
            executable='talker',
            namespace=LaunchConfiguration('ros_namespace'),
        ),
    ])
