"""The vocabulary of the manager of controllers of ros_control (ROS 1): the services by which they are loaded."""

from __future__ import annotations

from typing import TYPE_CHECKING

from roslens.model.graph import Role
from roslens.source.extract.domain.abstract_value import Handle, Obj, Value
from roslens.source.extract.domain.kinds import all_of_kind
from roslens.source.extract.interpreter.vocabulary import CallSite, outer
from roslens.source.extract.overlays.ros.emit import endpoint
from roslens.source.extract.symbolic.text import Text

if TYPE_CHECKING:
    from roslens.source.extract.transfer.context import Context

_SERVICES = (
    ("list_controllers", "ListControllers"),
    ("list_controller_types", "ListControllerTypes"),
    ("load_controller", "LoadController"),
    ("unload_controller", "UnloadController"),
    ("switch_controller", "SwitchController"),
    ("reload_controller_libraries", "ReloadControllerLibraries"),
)
"""As of controller_manager.cpp of Noetic."""


@outer("controller_manager.ControllerManager")
def manager(ctx: Context, _thing: Value, called: CallSite) -> Value:
    """A manager of controllers, in the namespace of the handle that it is given."""
    if ctx.emitter.node.generation == "ros1":
        given = all_of_kind(called.arguments, Handle)
        handle = given[0] if given else Handle(ctx.emitter.node)
        for name, kind in _SERVICES:
            service = Text.of(f"controller_manager/{name}")
            endpoint(ctx, handle, called, Role.SERVICE_SERVER, service, f"controller_manager_msgs::{kind}")
    return Obj("controller_manager.ControllerManager")
