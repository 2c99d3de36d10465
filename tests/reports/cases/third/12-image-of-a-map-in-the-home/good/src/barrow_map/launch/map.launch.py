import os

from ament_index_python.packages import get_package_share_directory
from launch import LaunchDescription
from launch_ros.actions import Node


def generate_launch_description():
    field = os.path.join(get_package_share_directory('barrow_map'), 'maps', 'field.yaml')
    return LaunchDescription([
        Node(package='nav2_map_server', executable='map_server', name='map_server', parameters=[{'yaml_filename': field}]),
        Node(package='nav2_lifecycle_manager', executable='lifecycle_manager', name='lifecycle_manager',
             parameters=[{'autostart': True, 'node_names': ['map_server']}]),
    ])
