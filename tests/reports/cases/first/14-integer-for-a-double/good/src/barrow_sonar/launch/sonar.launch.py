import os

from ament_index_python.packages import get_package_share_directory
from launch import LaunchDescription
from launch_ros.actions import Node


def generate_launch_description():
    settings = os.path.join(get_package_share_directory('barrow_sonar'), 'config', 'sonar.yaml')
    return LaunchDescription([
        Node(package='barrow_sonar', executable='sonar', name='sonar', parameters=[settings]),
    ])
