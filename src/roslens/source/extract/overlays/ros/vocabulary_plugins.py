"""The vocabulary of pluginlib and class_loader: classes that are loaded by name, and lists that hold them."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from roslens.source.extract.domain.abstract_value import Obj, Unknown, Value, as_text
from roslens.source.extract.domain.kinds import all_of_kind, known_text
from roslens.source.extract.domain.table_key import hashable
from roslens.source.extract.facts.node_facts import PluginFact
from roslens.source.extract.interpreter.vocabulary import CallSite, method, outer
from roslens.source.extract.ir.type_names import type_name
from roslens.source.extract.symbolic.text import Text, unknown
from roslens.source.extract.symbols.symbol_table import Defined
from roslens.source.extract.transfer.plugin_choice import deciding_node
from roslens.source.extract.transfer.plugin_held import held_in, hold

if TYPE_CHECKING:
    from roslens.source.extract.transfer.context import Context

_LOADER = "pluginlib.ClassLoader"
_SEPARATOR = re.compile(r"[/:]")
_MOST = 64
"""So many plug-ins one evaluation follows."""


@outer(_LOADER, "class_loader.ClassLoader", "class_loader.MultiLibraryClassLoader", quiet=True)
def loader(_ctx: Context, _thing: Value, called: CallSite) -> Value:
    """A loader of classes."""
    base = known_text(called.argument(1)) if called.name == _LOADER else None
    return Obj(_LOADER, None, {"base": base or (called.templates[0] if called.templates else "")})


@method(_LOADER, "createInstance", "createSharedInstance", "createUniqueInstance", "createUnmanagedInstance",
        quiet=True)  # fmt: skip
def instance(ctx: Context, thing: Obj, called: CallSite) -> Value:
    """An object of a class is made by the name of the class: where a configuration is asked for, and it is known."""
    kind = as_text(called.argument(0))
    base = called.templates[0] if called.templates else thing.held("base", str) or ""
    node = deciding_node(ctx, kind)
    name = None if ctx.given.chosen is None else kind.usual
    defined = _class(ctx, name) if name and len(ctx.emitter.plugged) < _MOST else None
    fact = PluginFact(kind, called.evidence, base, "" if defined is None else defined.what.qualified_name)
    if fact not in node.plugins:
        node.plugins.append(fact)
        ctx.summaries.touch()
    if defined is None:
        return Unknown(f"a plug-in of {base or 'some class'}")
    ctx.summaries.touch()
    ctx.budget.extend()
    made = ctx.objects.construct(defined, [], {})
    match made:
        case Obj():
            ctx.emitter.plugged.append((made, node))
    return made


@method(_LOADER, "getName", quiet=True)
def plain_name(_ctx: Context, _thing: Value, called: CallSite) -> Value:
    """The name of a class without its package (pluginlib, class_loader_imp.hpp): ``a/B`` and ``a::B`` are ``B``."""
    kind = as_text(called.argument(0))
    last = None if kind.usual is None else _SEPARATOR.split(kind.usual)[-1]
    if kind.known is not None:
        return Text.of(last or "")
    return unknown(f"name of the plug-in {kind}", default=last)


def _class(ctx: Context, name: str) -> Defined | None:
    """Return the class that a name of a plug-in means: by the descriptions, else the class of that name."""
    whole = type_name(ctx.given.plugin_names.get(name, name).replace("/", "::"))[0]
    return ctx.index.class_of(whole, ctx.state.frame.path, "")


@method("std.vector", "push_back", "emplace_back", quiet=True)
def added(ctx: Context, thing: Obj, called: CallSite) -> Value:
    """Something is put at the end of a list: texts and plug-ins are remembered."""
    for one in called.arguments:
        ctx.callbacks.give(one)
    given = called.argument(0)
    place = len(all_of_kind(held_in(thing), int))
    match given:
        case Obj():
            if any(one is given for one, _ in ctx.emitter.plugged):
                hold(ctx, thing, place, given)
        case Text() if len(ctx.state.conditions) <= ctx.state.frame.depth + ctx.state.frame.passed:
            hold(ctx, thing, place, given)
        case _:
            hold(ctx, thing, None, Unknown("an item of a list"))
    return None


@method("std.vector", "back", "front", "at", quiet=True)
def end(_ctx: Context, thing: Obj, called: CallSite) -> Value:
    """One end of a list, or what is at a place of it."""
    held = held_in(thing)
    keys = sorted(all_of_kind(held, int))
    place = hashable(called.argument(0)) if called.name == "at" else None
    if called.name != "at" and keys:
        place = keys[0 if called.name == "front" else -1]
    return held.get(place, Unknown(f"{called.name} of a list"))
