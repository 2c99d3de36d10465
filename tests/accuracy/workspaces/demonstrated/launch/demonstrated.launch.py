from launch import LaunchDescription
from launch.actions import GroupAction
from launch_ros.actions import LifecycleNode, Node, PushRosNamespace

TOPICS = ["talker", "listener", "talker_qos", "listener_serialized"]


def generate_launch_description():
    apart = {"set_parameters_callback": "parameters", "introspection": "inspected"}
    return LaunchDescription(
        [
            *(Node(package="demo_nodes_py", executable=one) for one in TOPICS),
            *(Node(package="demo_nodes_py", executable=one, namespace=where) for one, where in apart.items()),
            Node(package="demo_nodes_py", executable="add_two_ints_server", remappings=[("add_two_ints", "add")]),
            Node(package="action_tutorials_py", executable="fibonacci_action_server"),
            GroupAction(
                [
                    PushRosNamespace("alone"),
                    Node(package="demo_nodes_py", executable="add_two_ints_client_async"),
                    Node(package="action_tutorials_py", executable="fibonacci_action_client"),
                ]
            ),
            LifecycleNode(package="lifecycle_py", executable="lifecycle_talker", name="lc_talker", namespace="managed"),
            Node(
                package="quality_of_service_demo_py",
                executable="qos_overrides_talker",
                parameters=[
                    {
                        "qos_overrides": {
                            "/qos_overrides_chatter": {"publisher": {"reliability": "best_effort", "depth": 9}}
                        }
                    }
                ],
            ),
            Node(package="quality_of_service_demo_py", executable="qos_overrides_listener"),
            Node(package="quality_of_service_demo_py", executable="message_lost_listener"),
        ]
    )
