"""The vocabulary of BehaviorTree.CPP as far as names depend on it: ports of nodes of behaviour trees."""

from __future__ import annotations

from typing import TYPE_CHECKING

from roslens.source.extract.domain.abstract_value import Invocation, Unknown, Value, as_text
from roslens.source.extract.domain.kinds import table_of
from roslens.source.extract.interpreter.vocabulary import CallSite, method, outer
from roslens.source.extract.symbolic.text import Hole, Text

if TYPE_CHECKING:
    from roslens.source.extract.transfer.context import Context


@method("BT.ThreadedAction", "getInput")
@method("BT.CoroActionNode", "getInput")
@method("BT.StatefulActionNode", "getInput")
@method("BT.SyncActionNode", "getInput")
@method("BT.ActionNodeBase", "getInput")
@method("BT.ControlNode", "getInput")
@method("BT.ConditionNode", "getInput")
@method("BT.DecoratorNode", "getInput")
@method("BT.TreeNode", "getInput", anywhere=True)
def port(ctx: Context, _thing: Value, called: CallSite) -> Value:
    """A port of a node of a behaviour tree is read: its value in the tree."""
    name = as_text(called.argument(0))
    value = Text((Hole(f"port {name} of the behaviour tree", default=_port_default(ctx, name)),))
    if len(called.written) > 1:
        ctx.assign(called.written[1], value)
        return Unknown("whether the port is set")
    return value


def _port_default(ctx: Context, name: Text) -> str | None:
    """Return the default that the class of a node of a behaviour tree gives a port."""
    thing = ctx.state.frame.object
    if thing is None:
        return None
    if "ports" not in thing.fields:
        thing.fields["ports"] = {}
        provided = ctx.named.method(thing, "providedPorts")
        if provided is not None:
            ctx.call(Invocation(provided))
    match table_of(thing.fields["ports"]).get(name):
        case str(default):
            return default
    return None


@outer("BT.InputPort", "BT.BidirectionalPort")
def declared_port(ctx: Context, _thing: Value, called: CallSite) -> Value:
    """A port is declared, with a default where it has three arguments."""
    members = ctx.state.frame.members or {}
    match members.get("ports"):
        case dict(ports) if len(called.arguments) > 2:
            ports[as_text(called.argument(0))] = as_text(called.argument(1)).usual
    return Unknown("a port")


@method("BT.BehaviorTreeFactory", "createTree", "createTreeFromFile", "createTreeFromText", quiet=True)
def tree(ctx: Context, _thing: Value, called: CallSite) -> Value:
    """Nodes of a behaviour tree are created: which ones is in a file that is not read."""
    given = called.argument(0)
    name = str(as_text(given)) if given is not None else "a file"
    note = (called.evidence, f"a behaviour tree is created from {name}: the endpoints of its nodes are unknown")
    if note not in ctx.emitter.node.unresolved:
        ctx.emitter.node.unresolved.append(note)
        ctx.summaries.touch()
    return Unknown("a behaviour tree")
