import os

from ament_index_python.packages import get_package_share_directory
from launch import LaunchDescription
from launch_ros.actions import Node


def generate_launch_description():
    count = os.path.join(get_package_share_directory('barrow_count'), 'config', 'count.yaml')
    return LaunchDescription([
        Node(package='barrow_count', executable='counter.py', name='counter', namespace='left', parameters=[count]),
    ])
