from launch import LaunchDescription
from launch.substitutions import PathJoinSubstitution
from launch_ros.actions import Node
from launch_ros.substitutions import FindPackageShare


def generate_launch_description():
    config = PathJoinSubstitution([FindPackageShare('rover_drive'), 'config'])
    controllers = PathJoinSubstitution([config, 'controllers.yaml'])
    navigation = PathJoinSubstitution([config, 'nav.yaml'])
    return LaunchDescription([
        Node(package='controller_manager', executable='ros2_control_node', parameters=[controllers]),
        Node(package='controller_manager', executable='spawner', arguments=['drive']),
        Node(package='gazebo_ros', executable='spawn_entity.py', arguments=['-entity', 'rover']),
        Node(package='nav2_planner', executable='planner_server', name='planner_server', parameters=[navigation]),
        Node(package='nav2_behaviors', executable='behavior_server', name='behavior_server', parameters=[navigation]),
    ])
