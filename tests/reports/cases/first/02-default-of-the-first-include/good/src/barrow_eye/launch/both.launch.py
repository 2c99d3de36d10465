import os

from ament_index_python.packages import get_package_share_directory
from launch import LaunchDescription
from launch.actions import GroupAction, IncludeLaunchDescription
from launch.launch_description_sources import PythonLaunchDescriptionSource


def generate_launch_description():
    folder = os.path.join(get_package_share_directory('barrow_eye'), 'launch')
    front = IncludeLaunchDescription(
        PythonLaunchDescriptionSource(os.path.join(folder, 'front.launch.py')))
    rear = IncludeLaunchDescription(
        PythonLaunchDescriptionSource(os.path.join(folder, 'rear.launch.py')))
    return LaunchDescription([GroupAction([front]), GroupAction([rear])])
