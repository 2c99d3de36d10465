"""The vocabulary of buffers of transforms: the service that shows their frames."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from roslens.model.graph import Role
from roslens.source.extract.domain.abstract_value import Handle, Obj, Value
from roslens.source.extract.domain.kinds import node_in, object_of
from roslens.source.extract.interpreter.vocabulary import CallSite, outer
from roslens.source.extract.overlays.ros.emit import endpoint
from roslens.source.extract.symbolic.text import Text, Written

if TYPE_CHECKING:
    from roslens.source.extract.transfer.context import Context

_FRAMES, _TYPE = "tf2_frames", "tf2_msgs::srv::FrameGraph"


@outer("tf2_ros.Buffer", "tf2_ros.buffer.Buffer")
def buffer(ctx: Context, thing: Value, called: CallSite) -> Value:
    """A buffer of transforms.

    In ROS 2 it serves its frames where it is given a node. In ROS 1 it does so where ``debug`` is true, once in a node:
    by default in Python, and not in C++ (tf2_ros, buffer.py, buffer.h, buffer.cpp).
    """
    found = object_of(thing) or Obj("tf2_ros.Buffer")
    if ctx.emitter.node.generation == "ros2":
        node = next((one for one in _given(called) if node_in(one) is not None), None)
        if node is not None:
            endpoint(ctx, node, called, Role.SERVICE_SERVER, Text.of(_FRAMES), _TYPE)
        return found
    debug = called.argument(1, "debug", default=called.evidence.path.endswith(".py"))
    holds, name = ctx.truth(debug), Text.of("~", _FRAMES)
    if holds is False or any(one.name == name for one in ctx.emitter.node.endpoints):
        return found
    note = [] if holds else [Written("its buffer of transforms is created with debug")]
    ctx.state.conditions += note
    endpoint(ctx, Handle(ctx.emitter.node), called, Role.SERVICE_SERVER, name, _TYPE)
    del ctx.state.conditions[len(ctx.state.conditions) - len(note) :]
    return found


def _given(called: CallSite) -> Sequence[Value]:
    return [called.keywords["node"]] if "node" in called.keywords else called.arguments
