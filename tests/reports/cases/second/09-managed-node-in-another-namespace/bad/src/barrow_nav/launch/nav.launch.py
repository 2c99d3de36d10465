from launch import LaunchDescription
from launch_ros.actions import Node


def generate_launch_description():
    return LaunchDescription([
        Node(
            package='nav2_controller',
            executable='controller_server',
            name='controller_server',
            namespace='field',
        ),
        Node(
            package='nav2_planner',
            executable='planner_server',
            name='planner_server',
        ),
        Node(
            package='nav2_lifecycle_manager',
            executable='lifecycle_manager',
            name='lifecycle_manager',
            parameters=[{
                'autostart': True,
                'node_names': ['controller_server', 'planner_server'],
            }],
        ),
    ])
