from launch import LaunchDescription
from launch_ros.actions import Node


def generate_launch_description():
    return LaunchDescription([
        Node(
            package='tf2_ros',
            executable='static_transform_publisher',
            name='receiver_frame',
            arguments='--x 0.2 --y 0 --z 0.9 --roll 0 --pitch 0 --yaw 1.57 --frame-id base_link --child-frame-id receiver'.split(),
        ),
    ])
