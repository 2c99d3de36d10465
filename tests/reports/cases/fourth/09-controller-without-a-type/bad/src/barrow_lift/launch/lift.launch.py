import os

from ament_index_python.packages import get_package_share_directory
from launch import LaunchDescription
from launch_ros.actions import Node


def generate_launch_description():
    lift = os.path.join(get_package_share_directory('barrow_lift'), 'config', 'lift.yaml')
    return LaunchDescription([
        Node(package='controller_manager', executable='ros2_control_node', parameters=[lift],
             remappings=[('~/robot_description', '/robot_description')]),
        Node(package='controller_manager', executable='spawner', arguments=['joint_state_broadcaster']),
        Node(package='controller_manager', executable='spawner', arguments=['lift_controller']),
    ])
