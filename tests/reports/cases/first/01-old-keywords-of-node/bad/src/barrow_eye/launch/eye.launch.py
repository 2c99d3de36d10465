from launch import LaunchDescription
from launch_ros.actions import Node


def generate_launch_description():
    return LaunchDescription([
        Node(
            package='barrow_eye',
            node_executable='camera',
            node_name='camera',
            output='screen',
        ),
    ])
