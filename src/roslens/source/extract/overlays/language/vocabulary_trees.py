"""The vocabulary of BehaviorTree.CPP as far as names depend on it: ports of nodes of behaviour trees."""

from __future__ import annotations

from typing import TYPE_CHECKING

from roslens.source.extract.domain.abstract_value import Invocation, Obj, Unknown, Value, as_text
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
    """A port of a node of a behaviour tree is read: what the tree says."""
    name = as_text(called.argument(0))
    value = Text((Hole(f"port {name} of the behaviour tree", default=_port_default(ctx, name)),))
    if len(called.written) > 1:
        ctx.assign(called.written[1], value)
        return Unknown("whether the port is set")
    return value


def _port_default(ctx: Context, name: Text) -> str | None:
    """Return the default that the class of a node of a behaviour tree gives a port."""
    thing = ctx.state.frame.self
    if not isinstance(thing, Obj):
        return None
    if "ports" not in thing.fields:
        thing.fields["ports"] = {}
        provided = ctx.named.method(thing, "providedPorts")
        if provided is not None:
            ctx.call(Invocation(provided))
    ports = thing.fields["ports"]
    default = ports.get(name) if isinstance(ports, dict) else None
    return default if isinstance(default, str) else None


@outer("BT.InputPort", "BT.BidirectionalPort")
def declared_port(ctx: Context, _thing: Value, called: CallSite) -> Value:
    """A port is declared, with a default where it has three arguments."""
    thing = ctx.state.frame.self
    default = called.argument(1)
    ports = thing.fields.get("ports") if isinstance(thing, Obj) else None
    if isinstance(ports, dict) and len(called.arguments) > 2:
        ports[as_text(called.argument(0))] = as_text(default).usual
    return Unknown("a port")


@method("BT.BehaviorTreeFactory", "createTree", "createTreeFromFile", "createTreeFromText", quiet=True)
def tree(ctx: Context, _thing: Value, called: CallSite) -> Value:
    """Nodes of a behaviour tree are made: which ones says a file, that is not read."""
    given = called.argument(0)
    name = str(as_text(given)) if given is not None else "a file"
    note = (called.evidence, f"a behaviour tree is made of {name}: what its nodes make is unknown")
    if note not in ctx.emitter.node.unresolved:
        ctx.emitter.node.unresolved.append(note)
        ctx.summaries.touch()
    return Unknown("a behaviour tree")
