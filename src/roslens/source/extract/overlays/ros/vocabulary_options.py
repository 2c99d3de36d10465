"""The vocabulary of options of nodes: what command line and parameters code gives a node that it makes.

A node that code makes with arguments of its own is renamed and remapped by them before those of the process are looked
at (rcl, ``rcl_remap_node_name``); without any it takes the name that is given to its process.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from roslens.source.extract.domain.abstract_value import Named, Names, NodeBuilder, Obj, Unknown, Value, as_text
from roslens.source.extract.domain.guarded import Guarded
from roslens.source.extract.domain.kinds import all_of_kind, items_of
from roslens.source.extract.domain.outside_options import OPTIONS, OUTSIDE
from roslens.source.extract.facts.node_facts import Inherits
from roslens.source.extract.interpreter.vocabulary import CallSite, method, node_of, outer
from roslens.source.extract.symbolic.text import Hole, Text

if TYPE_CHECKING:
    from roslens.source.extract.transfer.context import Context

_DECLARES = "automatically_declare_parameters_from_overrides"
_SAME = (
    "use_intra_process_comms", "enable_topic_statistics", "start_parameter_services",
    "start_parameter_event_publisher", "enable_rosout", "allow_undeclared_parameters", "context", "clock_qos",
    "use_clock_thread", "parameter_event_qos", "rosout_qos", "enable_logger_service",
    "parameter_event_publisher_options", "allocator", "clock_type",
)  # fmt: skip


@outer(OPTIONS)
def options(_ctx: Context, thing: Value, called: CallSite) -> Value:
    """Options of a node: those of a copy, or none."""
    given = called.argument(0)
    found = _copy(given) if isinstance(given, Obj) else Obj(OPTIONS, None, {"-arguments": []})
    if isinstance(thing, Obj):
        thing.fields.update(found.fields)
        return thing
    return found


def _copy(given: Obj) -> Obj:
    return Obj(OPTIONS, None, {key: list(one) if isinstance(one, list) else one for key, one in given.fields.items()})


@method(OPTIONS, "arguments")
def arguments(_ctx: Context, thing: Obj, called: CallSite) -> Value:
    """The command line of the node is asked for, or given."""
    if not called.arguments:
        held = thing.fields.get("-arguments", [])
        return list(held) if isinstance(held, list) else held
    given = called.argument(0)
    # What is added where it is not there yet is among the arguments in any case.
    thing.fields["-arguments"] = (
        [one.value if isinstance(one, Guarded) else one for one in given] if isinstance(given, list) else given
    )
    return thing


@method(OPTIONS, "use_global_arguments")
def use_global(_ctx: Context, thing: Obj, called: CallSite) -> Value:
    """Whether the command line of the process is for the node too."""
    if not called.arguments:
        return thing.fields.get("-global", True)
    thing.fields["-global"] = called.argument(0)
    return thing


@method(OPTIONS, "parameter_overrides", "append_parameter_override")
def overrides(_ctx: Context, thing: Obj, called: CallSite) -> Value:
    """Values of parameters are given to the node."""
    if not called.arguments:
        return thing.fields.get("-overrides", [])
    held = thing.fields.setdefault("-overrides", [])
    if called.name.startswith("append"):
        items_of(held).append([called.argument(0), called.argument(1)])
    else:
        given = called.argument(0)
        thing.fields["-overrides"] = list(given) if isinstance(given, list) else given
    return thing


@method(OPTIONS, _DECLARES)
def declares(_ctx: Context, thing: Obj, called: CallSite) -> Value:
    """Whether the node declares each parameter that is set for it."""
    if not called.arguments:
        return thing.fields.get("-declares", False)
    thing.fields["-declares"] = called.argument(0)
    return thing


@method(OPTIONS, *_SAME)
def same(_ctx: Context, thing: Value, called: CallSite) -> Value:
    """What says nothing of names."""
    return thing if called.arguments else Unknown(f"{called.name} of the options")


@method("node", "get_node_options")
def options_of(ctx: Context, thing: Value, _called: CallSite) -> Value:
    """The options of a node are asked for."""
    held = node_of(ctx, thing).options
    return _copy(held) if isinstance(held, Obj) else Unknown("options of the node")


def given_options(called: CallSite) -> Obj | None:
    """Return the options that a node is made with; None where it is made without."""
    for one in (*called.arguments, *called.keywords.values()):
        if isinstance(one, Obj) and one.type == OPTIONS:
            return one
    if not {"cli_args", "use_global_arguments", "parameter_overrides", _DECLARES} & set(called.keywords):
        return None
    held: Names = {"-arguments": called.keywords.get("cli_args") or []}
    held["-global"] = called.keywords.get("use_global_arguments", True)
    held["-overrides"] = called.keywords.get("parameter_overrides") or []
    held["-declares"] = called.keywords.get(_DECLARES, False)
    return Obj(OPTIONS, None, held)


def take_options(ctx: Context, building: NodeBuilder, given: Obj, called: CallSite) -> None:
    """Let hold for a node what its options say."""
    building.options = given
    words = given.fields.get("-arguments", [])
    match words:
        case list():
            inherits = given.fields.get("-inherits")
            building.inherits = inherits if isinstance(inherits, Inherits) else Inherits.NOTHING
            if building.inherits is Inherits.ALL and words != [OUTSIDE]:
                building.inherits = Inherits.ALL if OUTSIDE in words else Inherits.PARAMETERS
            elif OUTSIDE in words:
                building.inherits = building.inherits if building.inherits is Inherits.ALL else Inherits.ARGUMENTS
            building.arguments = [as_text(one) for one in words if one != OUTSIDE]
        case _:
            _doubt(building, called, f"its arguments are {as_text(words)}")
    if isinstance(of_process := given.fields.get("-global", True), bool):
        building.global_arguments = of_process
    else:
        _doubt(building, called, "whether those of the process hold for it is unknown")
    building.declares_set = given.fields.get("-declares") is True
    values = given.fields.get("-overrides", [])
    pairs = list(values.items()) if isinstance(values, dict) else items_of(values)
    for one in pairs:
        if isinstance(one, list | tuple) and len(one) == 2:
            building.settings.append((as_text(one[0]), as_text(one[1])))
    del ctx


def doubt_options(building: NodeBuilder, called: CallSite) -> None:
    """Note where one of the arguments may be options, or a namespace, that nobody knows."""
    unknown_ones = all_of_kind(called.arguments[1:3], Unknown)
    if unknown_ones:
        _doubt(building, called, f"its options are {as_text(unknown_ones[-1])}")


def _doubt(building: NodeBuilder, called: CallSite, reason: str) -> None:
    building.doubt = building.doubt or reason
    building.unresolved.append((called.evidence, f"{reason}: its name and those of its topics may be others"))


@outer("std.replace")
def replaced(ctx: Context, _thing: Value, called: CallSite) -> Value:
    """Signs of a text are replaced by others: ``std::replace(name.begin(), name.end(), '/', '_')``."""
    of = getattr(getattr(called.written[0], "function", None), "of", None) if called.written else None
    before, after = called.argument(2), called.argument(3)
    if of is None or not isinstance(before, Text) or not isinstance(after, Text):
        return None
    value = ctx.value(of)
    if not isinstance(value, Text) or before.known is None or after.known is None:
        return None
    parts: list[str | Hole] = []
    for one in value.parts:
        match one:
            case str():
                parts.append(one.replace(before.known, after.known))
            case _:
                default = None if one.default in (None, "~") else (one.default or "").replace(before.known, after.known)
                parts.append(Hole(f"{one.reason} with {after.known} for {before.known}", "", default))
    ctx.assign(of, Text.of(*parts))
    return None


__all__ = ["Named"]
