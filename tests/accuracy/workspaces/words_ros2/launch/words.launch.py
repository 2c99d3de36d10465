from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, IncludeLaunchDescription
from launch.launch_description_sources import AnyLaunchDescriptionSource
from launch.substitutions import LaunchConfiguration, PathJoinSubstitution
from launch_ros.actions import Node
from launch_ros.substitutions import FindPackageShare


def generate_launch_description():
    share = FindPackageShare("words_ros2")
    topic = LaunchConfiguration("topic")
    config = PathJoinSubstitution([share, "config", "sources.yaml"])
    return LaunchDescription(
        [
            DeclareLaunchArgument("topic", default_value="chatter"),
            Node(package="words_ros2", executable="relay", arguments=[topic, [topic, "_slow"]]),
            Node(package="words_ros2", executable="relay", name="relay_of_one", arguments=["/said"]),
            Node(package="words_ros2", executable="sources", parameters=[config, {"rear.weight": 0.0}]),
            Node(package="words_ros2", executable="sources", namespace="usual"),
            Node(package="words_ros2", executable="count", arguments=["3", "ticks"], parameters=[{"step": 2}]),
            IncludeLaunchDescription(
                AnyLaunchDescriptionSource(PathJoinSubstitution([share, "launch", "record.launch.xml"])),
                launch_arguments={"topic": topic}.items(),
            ),
            IncludeLaunchDescription(
                AnyLaunchDescriptionSource(PathJoinSubstitution([share, "launch", "quiet.launch.yaml"]))
            ),
        ]
    )
