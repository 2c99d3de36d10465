from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, ExecuteProcess, OpaqueFunction
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node


def start(context):
    record = LaunchConfiguration('record')
    actions = [Node(package='barrow_eye', executable='camera', name='camera')]
    if record:
        actions.append(ExecuteProcess(cmd=['ros2', 'bag', 'record', '/camera_info']))
    return actions


def generate_launch_description():
    return LaunchDescription([
        DeclareLaunchArgument('record', default_value='false'),
        OpaqueFunction(function=start),
    ])
