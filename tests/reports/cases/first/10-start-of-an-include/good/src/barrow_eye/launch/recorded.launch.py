from launch import LaunchDescription
from launch.actions import ExecuteProcess, RegisterEventHandler
from launch.event_handlers import OnProcessStart
from launch_ros.actions import Node


def generate_launch_description():
    camera = Node(package='barrow_eye', executable='camera', name='camera')
    recorder = ExecuteProcess(cmd=['ros2', 'bag', 'record', '/camera_info'], output='screen')
    return LaunchDescription([
        camera,
        RegisterEventHandler(OnProcessStart(target_action=camera, on_start=[recorder])),
    ])
