"""Which modules are hooked when a node imports them; each hook is loaded only then."""

from __future__ import annotations

from types import ModuleType

from .when_imported import when_imported


def install() -> None:
    """Wait for the client libraries of ROS."""
    when_imported("rclpy.executors", _executors)
    when_imported("rclpy.publisher", _publisher)
    when_imported("rospy.topics", _topics)


def _executors(module: ModuleType) -> None:
    from .rclpy_hook import hook_executor

    hook_executor(module)


def _publisher(module: ModuleType) -> None:
    from .rclpy_hook import hook_publisher

    hook_publisher(module)


def _topics(module: ModuleType) -> None:
    from .ros1_statistics import hook_topics

    hook_topics(module)
