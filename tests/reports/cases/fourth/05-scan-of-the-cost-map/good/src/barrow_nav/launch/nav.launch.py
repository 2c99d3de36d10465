import os

from ament_index_python.packages import get_package_share_directory
from launch import LaunchDescription
from launch_ros.actions import Node


def generate_launch_description():
    nav = os.path.join(get_package_share_directory('barrow_nav'), 'config', 'nav.yaml')
    return LaunchDescription([
        Node(package='barrow_nav', executable='laser.py', name='laser'),
        Node(package='nav2_controller', executable='controller_server', name='controller_server', parameters=[nav]),
        Node(package='nav2_lifecycle_manager', executable='lifecycle_manager', name='lifecycle_manager',
             parameters=[{'autostart': True, 'node_names': ['controller_server']}]),
    ])
