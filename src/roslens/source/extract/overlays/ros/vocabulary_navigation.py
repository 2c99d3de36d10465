"""The vocabulary of nav2_util: a client of a service and a server of an action that nodes of Nav2 hold.

Both are class templates of the interface. The client is given a name and a node (service_client.hpp), the server a
node, a name and what executes a goal (simple_action_server.hpp); newer releases have them in nav2_ros_common.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from roslens.model.graph import Role
from roslens.source.extract.domain.abstract_value import Callable, Unknown, Value
from roslens.source.extract.interpreter.vocabulary import CallSite, outer
from roslens.source.extract.overlays.ros.emit import endpoint

if TYPE_CHECKING:
    from roslens.source.extract.transfer.context import Context


@outer("nav2_util.ServiceClient", "nav2_ros_common.ServiceClient")
def service_client(ctx: Context, _thing: Value, called: CallSite) -> Value:
    """A client of a service."""
    return endpoint(
        ctx, called.argument(1, "provided_node"), called, Role.SERVICE_CLIENT, called.argument(0, "service_name"),
        _interface(called),
    )  # fmt: skip


@outer("nav2_util.SimpleActionServer", "nav2_ros_common.SimpleActionServer")
def action_server(ctx: Context, _thing: Value, called: CallSite) -> Value:
    """A server of an action, whose goals a function of the node executes."""
    execute = called.given(Callable, 2, "execute_callback")
    return endpoint(
        ctx, called.argument(0, "node"), called, Role.ACTION_SERVER, called.argument(1, "action_name"),
        _interface(called), callback=execute,
    )  # fmt: skip


def _interface(called: CallSite) -> Value:
    return called.templates[0] if called.templates else Unknown("its type")
