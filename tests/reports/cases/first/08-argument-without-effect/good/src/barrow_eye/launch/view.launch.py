from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument
from launch.conditions import IfCondition
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node


def generate_launch_description():
    return LaunchDescription([
        DeclareLaunchArgument('gui', default_value='false', description='Show the images in a window'),
        Node(package='barrow_eye', executable='camera', name='camera', output='screen'),
        Node(package='rviz2', executable='rviz2', name='viewer', output='log',
             condition=IfCondition(LaunchConfiguration('gui'))),
    ])
