from launch import LaunchDescription
from launch.actions import EmitEvent, RegisterEventHandler
from launch.events import matches_action
from launch_ros.actions import LifecycleNode
from launch_ros.event_handlers import OnStateTransition
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
    on_inactive = RegisterEventHandler(OnStateTransition(
        target_lifecycle_node=gripper, goal_state='inactive', entities=[activate]))
    return LaunchDescription([gripper, on_inactive, configure])
