from launch import LaunchDescription
from launch_ros.actions import Node


def generate_launch_description():
    return LaunchDescription([
        Node(
            package='barrow_pair',
            executable='origin.py',
            name='origin',
            parameters=[
                {'name': 'frame', 'value': 'map'},
            ],
        ),
    ])
