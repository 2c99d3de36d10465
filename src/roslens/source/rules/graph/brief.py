"""Programs that do one thing and end: for what lasts they are no part of the system."""

from __future__ import annotations

from roslens.model.configuration import ConfiguredNode
from roslens.model.graph import Role

_PROGRAMS = frozenset(
    {
        ("ros_gz_sim", "create"),
        ("ros_ign_gazebo", "create"),
        ("ros_gz_sim", "remove"),
        ("gazebo_ros", "spawn_entity.py"),
        ("gazebo_ros", "spawn_model"),
        ("controller_manager", "spawner"),
        ("controller_manager", "spawner.py"),
        ("controller_manager", "unspawner"),
        ("controller_manager", "hardware_spawner"),
        ("webots_ros2_driver", "ros2_supervisor.py"),
        ("urdf_spawner", "urdf_spawner"),
    }
)

_CALLING = frozenset({Role.SERVICE_CLIENT, Role.ACTION_CLIENT})


def is_brief(node: ConfiguredNode) -> bool:
    """Return whether a node ends as soon as it has done what it is started for.

    It is one of the programs that are known, or nothing that is known of its code could keep it at work: it only calls.
    """
    if (node.package, node.executable) in _PROGRAMS:
        return True
    roles = {one.endpoint.role for one in node.endpoints if not one.implicit}
    return bool(roles) and roles <= _CALLING and not node.timers
