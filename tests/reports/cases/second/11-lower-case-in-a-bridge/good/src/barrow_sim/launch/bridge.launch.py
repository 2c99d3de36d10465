import os

from ament_index_python.packages import get_package_share_directory
from launch import LaunchDescription
from launch_ros.actions import Node


def generate_launch_description():
    pairs = os.path.join(get_package_share_directory('barrow_sim'), 'config', 'bridge.yaml')
    return LaunchDescription([
        Node(package='ros_gz_bridge', executable='parameter_bridge', parameters=[{'config_file': pairs}]),
    ])
