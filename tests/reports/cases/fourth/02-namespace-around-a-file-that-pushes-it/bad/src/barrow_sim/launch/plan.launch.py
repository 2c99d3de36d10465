from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, GroupAction
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node, PushRosNamespace


def generate_launch_description():
    return LaunchDescription([
        DeclareLaunchArgument('namespace', default_value=''),
        GroupAction([
            PushRosNamespace(LaunchConfiguration('namespace')),
            Node(package='demo_nodes_cpp', executable='talker', name='planner'),
        ]),
    ])
