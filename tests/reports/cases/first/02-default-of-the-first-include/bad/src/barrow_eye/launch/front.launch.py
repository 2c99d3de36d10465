from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node


def generate_launch_description():
    return LaunchDescription([
        DeclareLaunchArgument('rate', default_value='30.0'),
        Node(
            package='barrow_eye',
            executable='camera',
            name='front_camera',
            namespace='front',
            parameters=[{'rate': LaunchConfiguration('rate')}],
        ),
    ])
