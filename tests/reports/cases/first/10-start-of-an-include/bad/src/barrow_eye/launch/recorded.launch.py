from launch import LaunchDescription
from launch.actions import ExecuteProcess, IncludeLaunchDescription, RegisterEventHandler
from launch.event_handlers import OnProcessStart
from launch.launch_description_sources import PythonLaunchDescriptionSource
from launch.substitutions import PathJoinSubstitution
from launch_ros.substitutions import FindPackageShare


def generate_launch_description():
    camera = IncludeLaunchDescription(PythonLaunchDescriptionSource(
        PathJoinSubstitution([FindPackageShare('barrow_eye'), 'launch', 'camera.launch.py'])))
    recorder = ExecuteProcess(cmd=['ros2', 'bag', 'record', '/camera_info'], output='screen')
    return LaunchDescription([
        camera,
        RegisterEventHandler(OnProcessStart(target_action=camera, on_start=[recorder])),
    ])
