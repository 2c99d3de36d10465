from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, GroupAction, IncludeLaunchDescription
from launch.conditions import IfCondition, UnlessCondition
from launch.launch_description_sources import AnyLaunchDescriptionSource
from launch.substitutions import LaunchConfiguration, PathJoinSubstitution, PythonExpression
from launch_ros.actions import Node, PushRosNamespace, SetParameter, SetRemap
from launch_ros.substitutions import FindPackageShare

SIDES = ("left", "right")


def arm(side, **parameters):
    config = PathJoinSubstitution([FindPackageShare("arm_ros2"), "config", "arm.yaml"])
    return Node(package="arm_ros2", executable="arm", namespace=side, parameters=[config, parameters])


def commander(share, side):
    source = AnyLaunchDescriptionSource([share, "/launch/commander.launch.yaml"])
    return IncludeLaunchDescription(source, launch_arguments=[("side", side)])


def generate_launch_description():
    share = FindPackageShare("arm_ros2")
    xml = AnyLaunchDescriptionSource(PathJoinSubstitution([share, "launch", "gripper.launch.xml"]))
    both = PythonExpression(["'", LaunchConfiguration("sides"), "' == 'both'"])
    return LaunchDescription(
        [
            DeclareLaunchArgument("sides", default_value="both", choices=["both", "left"]),
            DeclareLaunchArgument("gripper", default_value="true"),
            arm("left"),
            GroupAction([arm("right", stop_topic="/emergency_stop", rate=5.0)], condition=IfCondition(both)),
            GroupAction(
                [
                    PushRosNamespace("tools"),
                    SetParameter("force", 7.5),
                    SetRemap("opening", "width"),
                    IncludeLaunchDescription(xml, launch_arguments={"name": "left_gripper"}.items()),
                ],
                condition=IfCondition(LaunchConfiguration("gripper")),
            ),
            *[commander(share, side) for side in SIDES],
            Node(package="arm_ros2", executable="commander", name="spare", condition=UnlessCondition(both)),
        ]
    )
