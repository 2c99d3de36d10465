"""The vocabulary of options of nodes: what command line and parameters code gives a node that it makes.

A node that code makes with arguments of its own is renamed and remapped by them before those of the process are looked
at (rcl, ``rcl_remap_node_name``); without any it takes the name that is given to its process.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from roslens.source.extract.domain.abstract_value import Named, Names, NodeBuilder, Obj, Unknown, Value, as_text
from roslens.source.extract.domain.guarded import unguarded
from roslens.source.extract.domain.kinds import all_of_kind, items_of, known_text, object_of, table_of, text_of
from roslens.source.extract.domain.outside_options import OPTIONS, OUTSIDE
from roslens.source.extract.facts.node_facts import Inherits
from roslens.source.extract.interpreter.vocabulary import CallSite, method, node_of, outer
from roslens.source.extract.symbolic.text import Hole

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
    given = called.given(Obj, 0)
    found = Obj(OPTIONS, None, {"-arguments": []}) if given is None else _copy(given)
    return made_on(thing, found)


def made_on(thing: Value, made: Obj) -> Obj:
    """Return the object that a constructor is evaluated on, with the members of what it makes; that where none is."""
    found = object_of(thing)
    if found is None:
        return made
    found.fields.update(made.fields)
    return found


def _copied(value: Value) -> Value:
    """Return a list of its own where a value is one; other values as they are."""
    match value:
        case list():
            return list(value)
    return value


def _copy(given: Obj) -> Obj:
    return Obj(OPTIONS, None, {key: _copied(one) for key, one in given.fields.items()})


@method(OPTIONS, "arguments")
def arguments(_ctx: Context, thing: Obj, called: CallSite) -> Value:
    """The command line of the node is asked for, or given."""
    if not called.arguments:
        return _copied(thing.fields.get("-arguments", []))
    given = called.argument(0)
    match given:
        case list():
            # What is added where it is not there yet is among the arguments in any case.
            thing.fields["-arguments"] = [unguarded(one) for one in given]
        case _:
            thing.fields["-arguments"] = given
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
        thing.fields["-overrides"] = _copied(called.argument(0))
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
    """Options that do not affect names."""
    return thing if called.arguments else Unknown(f"{called.name} of the options")


@method("node", "get_node_options")
def options_of(ctx: Context, thing: Value, _called: CallSite) -> Value:
    """The options of a node are asked for."""
    held = object_of(node_of(ctx, thing).options)
    return Unknown("options of the node") if held is None else _copy(held)


def given_options(called: CallSite) -> Obj | None:
    """Return the options that a node is made with; None where it is made without."""
    for one in all_of_kind((*called.arguments, *called.keywords.values()), Obj):
        if one.type == OPTIONS:
            return one
    if not {"cli_args", "use_global_arguments", "parameter_overrides", _DECLARES} & set(called.keywords):
        return None
    held: Names = {"-arguments": called.keywords.get("cli_args") or []}
    held["-global"] = called.keywords.get("use_global_arguments", True)
    held["-overrides"] = called.keywords.get("parameter_overrides") or []
    held["-declares"] = called.keywords.get(_DECLARES, False)
    return Obj(OPTIONS, None, held)


def _inherited(stated: Inherits | None, words: list[Value]) -> Inherits:
    """Return what a node takes of what the component is loaded with, by its options and its command line."""
    if stated is Inherits.ALL:
        return Inherits.ALL if OUTSIDE in words else Inherits.PARAMETERS
    return Inherits.ARGUMENTS if OUTSIDE in words else stated or Inherits.NOTHING


def take_options(ctx: Context, building: NodeBuilder, given: Obj, called: CallSite) -> None:
    """Apply the options of a node."""
    building.options = given
    words = given.fields.get("-arguments", [])
    match words:
        case list():
            building.inherits = _inherited(given.held("-inherits", Inherits), words)
            building.arguments = [as_text(one) for one in words if one != OUTSIDE]
        case _:
            _doubt(building, called, f"its arguments are {as_text(words)}")
    match given.fields.get("-global", True):
        case bool(of_process):
            building.global_arguments = of_process
        case _:
            _doubt(building, called, "it is unknown whether those of the process apply to it")
    building.declares_set = given.fields.get("-declares") is True
    values = given.fields.get("-overrides", [])
    for one in (*table_of(values).items(), *items_of(values)):
        match one:
            case [name, value]:
                building.settings.append((as_text(name), as_text(value)))
    del ctx


def doubt_options(building: NodeBuilder, called: CallSite) -> None:
    """Note if one of the arguments may be unknown options, or an unknown namespace."""
    unknown_ones = all_of_kind(called.arguments[1:3], Unknown)
    if unknown_ones:
        _doubt(building, called, f"its options are {as_text(unknown_ones[-1])}")


def _doubt(building: NodeBuilder, called: CallSite, reason: str) -> None:
    building.doubt = building.doubt or reason
    building.unresolved.append((called.evidence, f"{reason}: its name and those of its topics may differ"))


@outer("std.replace")
def replaced(ctx: Context, _thing: Value, called: CallSite) -> Value:
    """Signs of a text are replaced by others: ``std::replace(name.begin(), name.end(), '/', '_')``."""
    of = getattr(getattr(called.written[0], "function", None), "of", None) if called.written else None
    before, after = known_text(called.argument(2)), known_text(called.argument(3))
    value = None if of is None or before is None or after is None else text_of(ctx.value(of))
    if of is None or before is None or after is None or value is None:
        return None

    def replaced_in(hole: Hole) -> Hole:
        default = None if hole.default in (None, "~") else (hole.default or "").replace(before, after)
        return Hole(f"{hole.reason} with {after} for {before}", "", default)

    ctx.assign(of, value.with_known(lambda part: part.replace(before, after)).with_holes(replaced_in))
    return None


__all__ = ["Named"]
