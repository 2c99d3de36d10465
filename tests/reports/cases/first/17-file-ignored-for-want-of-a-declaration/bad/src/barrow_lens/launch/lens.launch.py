import os

from ament_index_python.packages import get_package_share_directory
from launch import LaunchDescription
from launch_ros.actions import Node


def generate_launch_description():
    settings = os.path.join(get_package_share_directory('barrow_lens'), 'config', 'lens.yaml')
    return LaunchDescription([
        Node(package='barrow_lens', executable='lens', name='lens', parameters=[settings]),
    ])
