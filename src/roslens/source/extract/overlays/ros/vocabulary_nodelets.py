"""The vocabulary of programs of ROS 1 that load nodelets themselves: ``nodelet::Loader`` and what it is given.

The name of a nodelet is resolved as that of a node handle, and so are its remappings (nodelet, loader.cpp; roscpp,
node_handle.cpp).
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from roslens.model.graph import Role
from roslens.source.extract.domain.abstract_value import Handle, Obj, Remappings, Unknown, Value, as_text
from roslens.source.extract.facts.node_facts import LoadFact
from roslens.source.extract.interpreter.vocabulary import CallSite, method, outer
from roslens.source.extract.overlays.ros.emit import endpoint
from roslens.source.extract.symbolic.text import Hole, Text, unknown

if TYPE_CHECKING:
    from roslens.source.extract.transfer.context import Context

_SERVICES = (("list", "NodeletList"), ("load_nodelet", "NodeletLoad"), ("unload_nodelet", "NodeletUnload"))
_STRINGS = ("std::string", "std::string")


@outer("ros.M_string", "nodelet.M_string", quiet=True)
def remappings(_ctx: Context, _thing: Value, called: CallSite) -> Value:
    """A map of remappings, empty until names are added."""
    given = called.argument(0)
    return Unknown("remappings passed by the caller") if given is not None else Remappings()


@outer("std.map", quiet=True)
def mapping(_ctx: Context, _thing: Value, called: CallSite) -> Value:
    """A map: one of texts may be one of remappings."""
    plain = tuple(one.strip() for one in called.templates) == _STRINGS and not called.arguments
    return Remappings() if plain else Obj("std.map")


@outer("nodelet.Loader")
def loader(ctx: Context, _thing: Value, called: CallSite) -> Value:
    """A loader of nodelets, with services of a manager where the call asks for them."""
    ctx.emitter.node.generation = "ros1"
    given = called.argument(0, default=True)
    match given:
        case Handle():
            _services(ctx, given, called)
        case True:
            _services(ctx, Handle(ctx.emitter.node, Text.of("~")), called)
        case Unknown() | Text():
            reason = "whether this loader of nodelets has the services of a manager depends on " + str(as_text(given))
            ctx.emitter.node.unresolved.append((called.evidence, reason))
    return Obj("nodelet.Loader")


def _services(ctx: Context, handle: Handle, called: CallSite) -> None:
    for name, kind in _SERVICES:
        endpoint(ctx, handle, called, Role.SERVICE_SERVER, Text.of(name), f"nodelet::{kind}")


@method("nodelet.Loader", "load")
def load(ctx: Context, _thing: Value, called: CallSite) -> Value:
    """A nodelet is loaded into this process."""
    given = called.argument(2)
    match given:
        case Remappings():
            pairs = tuple((as_text(source), as_text(target)) for source, target in given.items())
        case _:
            # Any name may be another one then.
            pairs = ((unknown("remappings of the nodelet"), unknown("remappings of the nodelet")),)
    kind = called.argument(1)
    fact = LoadFact(
        as_text(called.argument(0)),
        as_text(kind) if kind is not None else Text((Hole("class of the nodelet"),)),
        called.evidence,
        pairs,
        tuple(dict.fromkeys(ctx.state.conditions)),
    )
    if fact not in ctx.emitter.node.loads:
        ctx.emitter.node.loads.append(fact)
    return Unknown("whether the nodelet is loaded")
