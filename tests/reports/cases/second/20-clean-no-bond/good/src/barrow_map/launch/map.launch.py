from launch import LaunchDescription
from launch_ros.actions import Node


def generate_launch_description():
    return LaunchDescription([
        Node(package='nav2_costmap_2d', executable='nav2_costmap_2d', name='costmap', namespace='costmap'),
        Node(package='nav2_lifecycle_manager', executable='lifecycle_manager', name='lifecycle_manager_map',
             parameters=[{'autostart': True, 'bond_timeout': 0.0, 'node_names': ['costmap/costmap']}]),
    ])
