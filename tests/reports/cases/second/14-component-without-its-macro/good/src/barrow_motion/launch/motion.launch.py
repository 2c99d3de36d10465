from launch import LaunchDescription
from launch_ros.actions import ComposableNodeContainer
from launch_ros.descriptions import ComposableNode


def generate_launch_description():
    return LaunchDescription([
        ComposableNodeContainer(
            package='rclcpp_components',
            executable='component_container',
            name='motion_container',
            namespace='',
            composable_node_descriptions=[
                ComposableNode(package='barrow_motion', plugin='barrow_motion::Motion', name='motion'),
            ],
        ),
    ])
