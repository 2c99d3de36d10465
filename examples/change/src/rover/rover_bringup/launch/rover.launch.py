# Copyright 2025 The roslens authors
#
# Licensed under the Apache License, Version 2.0 (the "License");
# you may not use this file except in compliance with the License.
# You may obtain a copy of the License at
#
#     http://www.apache.org/licenses/LICENSE-2.0
#
# Unless required by applicable law or agreed to in writing, software
# distributed under the License is distributed on an "AS IS" BASIS,
# WITHOUT WARRANTIES OR CONDITIONS OF ANY KIND, either express or implied.
# See the License for the specific language governing permissions and
# limitations under the License.

"""Start the whole rover: body, base, sensors and, unless told otherwise, navigation."""

from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, GroupAction, IncludeLaunchDescription
from launch.conditions import IfCondition
from launch.launch_description_sources import AnyLaunchDescriptionSource
from launch.substitutions import Command, LaunchConfiguration, PathJoinSubstitution
from launch_ros.actions import Node, PushRosNamespace
from launch_ros.parameter_descriptions import ParameterValue
from launch_ros.substitutions import FindPackageShare


def generate_launch_description():
    """Return what to start."""
    share = FindPackageShare("rover_bringup")
    body = Command(["xacro ", PathJoinSubstitution([share, "urdf", "rover.urdf.xacro"])])
    namespace = LaunchConfiguration("namespace")
    device = LaunchConfiguration("device")

    arguments = [
        DeclareLaunchArgument("namespace", default_value="", description="where all nodes and topics live"),
        DeclareLaunchArgument("device", default_value="/dev/ttyUSB0", description="serial port of the motor board"),
        DeclareLaunchArgument("navigation", default_value="true", description="whether to drive missions"),
    ]
    nodes = GroupAction(
        [
            PushRosNamespace(namespace),
            Node(
                package="robot_state_publisher",
                executable="robot_state_publisher",
                parameters=[{"robot_description": ParameterValue(body, value_type=str)}],
            ),
            Node(
                package="rover_base",
                executable="base_node",
                name="rover_base",
                parameters=[PathJoinSubstitution([share, "config", "base.yaml"]), {"device": device}],
                output="screen",
            ),
            Node(package="rover_base", executable="battery_guard"),
            IncludeLaunchDescription(
                AnyLaunchDescriptionSource(PathJoinSubstitution([share, "launch", "sensors.launch.yaml"]))
            ),
            IncludeLaunchDescription(
                AnyLaunchDescriptionSource(PathJoinSubstitution([share, "launch", "navigation.launch.xml"])),
                condition=IfCondition(LaunchConfiguration("navigation")),
            ),
        ]
    )
    return LaunchDescription([*arguments, nodes])
