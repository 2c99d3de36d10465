import os

from ament_index_python.packages import get_package_share_directory
from launch import LaunchDescription
from launch_ros.actions import LifecycleNode


def generate_launch_description():
    follow = os.path.join(get_package_share_directory('barrow_follow'), 'config', 'follow.yaml')
    return LaunchDescription([
        LifecycleNode(
            package='nav2_controller',
            executable='controller_server',
            name='controller_server',
            namespace='',
            parameters=[follow],
        ),
    ])
