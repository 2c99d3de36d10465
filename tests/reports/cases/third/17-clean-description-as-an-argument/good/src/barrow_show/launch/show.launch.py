import os

from ament_index_python.packages import get_package_share_directory
from launch import LaunchDescription
from launch_ros.actions import Node


def generate_launch_description():
    model = os.path.join(get_package_share_directory('barrow_show'), 'urdf', 'barrow.urdf')
    return LaunchDescription([
        Node(package='joint_state_publisher', executable='joint_state_publisher', arguments=[model]),
    ])
