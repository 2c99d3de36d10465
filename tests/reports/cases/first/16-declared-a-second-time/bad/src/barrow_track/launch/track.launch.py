from launch import LaunchDescription
from launch_ros.actions import Node


def generate_launch_description():
    return LaunchDescription([
        Node(package='barrow_track', executable='track', name='track', parameters=[{'save_track': True}]),
    ])
