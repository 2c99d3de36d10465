from launch import LaunchDescription
from launch.actions import EmitEvent
from launch.events import matches_action
from launch_ros.actions import LifecycleNode
from launch_ros.events.lifecycle import ChangeState
from lifecycle_msgs.msg import Transition


def generate_launch_description():
    gripper = LifecycleNode(package='barrow_grip', executable='gripper', name='gripper', namespace='')
    configure = EmitEvent(event=ChangeState(
        lifecycle_node_matcher=matches_action(gripper),
        transition_id=Transition.TRANSITION_CONFIGURE))
    activate = EmitEvent(event=ChangeState(
        lifecycle_node_matcher=matches_action(gripper),
        transition_id=Transition.TRANSITION_ACTIVATE))
    return LaunchDescription([gripper, configure, activate])
