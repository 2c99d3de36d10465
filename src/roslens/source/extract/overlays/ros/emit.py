"""How the vocabulary records what a node makes."""

from __future__ import annotations

from typing import TYPE_CHECKING

import msgspec

from roslens.model.graph import Role
from roslens.source.extract.domain.abstract_value import (
    Callable,
    Class,
    Foreign,
    Group,
    Made,
    Named,
    NodeBuilder,
    Obj,
    QosValue,
    Unknown,
    Value,
    as_text,
)
from roslens.source.extract.domain.earlier_values import without_defaults
from roslens.source.extract.domain.kinds import all_of_kind, first_of_kind, is_number, reason_of
from roslens.source.extract.domain.parameter_types import type_of_value
from roslens.source.extract.facts.node_facts import (
    EndpointFact,
    Evidence,
    Overrides,
    ParameterFact,
    Sure,
    Terms,
    TimerFact,
)
from roslens.source.extract.interpreter.vocabulary import CallSite, below, node_of
from roslens.source.extract.ir.program import Call, Expression, Function, Name
from roslens.source.extract.symbolic.condition import under_either
from roslens.source.extract.symbolic.reason import OfParameter
from roslens.source.extract.symbolic.text import Condition, Hole, IsSet, Text, unknown
from roslens.source.extract.symbols.interface_name import (
    included_interface,
    interface_name,
    lower_interface,
    message_of,
    of_generation,
    used_interface,
)
from roslens.source.extract.symbols.symbol_table import dotted, type_arguments, type_name
from roslens.source.extract.transfer.plugin_choice import chosen_value

if TYPE_CHECKING:
    from roslens.source.extract.transfer.context import Context

KINDS = {
    Role.PUBLISHER: "msg",
    Role.SUBSCRIPTION: "msg",
    Role.SERVICE_SERVER: "srv",
    Role.SERVICE_CLIENT: "srv",
    Role.ACTION_SERVER: "action",
    Role.ACTION_CLIENT: "action",
}


def endpoint(
    ctx: Context,
    receiver: Value,
    called: CallSite,
    role: Role,
    name: Value,
    kind: Value,
    *,
    qos: Value = None,
    queue: int = -1,
    latched: bool = False,
    callback: Value = None,
    group: Value = None,
    overrides: Overrides | None = None,
) -> Made:
    """Record an endpoint of the node that the receiver is."""
    node = node_of(ctx, receiver)
    written = below(receiver, as_text(name))
    if not written:
        written = unknown("a name that is not set")
    asked = ctx.state.asked_now()
    if asked and node.generation == "ros1" and written.holes:
        written = without_defaults(written, asked)
    evidence, through = origin(ctx, called, name)
    sure = sure_of(written, receiver)
    if sure is not Sure.CERTAIN or written.holes:
        evidence = msgspec.structs.replace(evidence, how=how(written), sure=sure)
    quality = first_of_kind((qos,), QosValue)
    fact = EndpointFact(
        role,
        written,
        type_text(ctx, kind, node.generation, role),
        evidence,
        qos=quality.qos if quality and node.generation == "ros2" else None,
        qos_unknown=quality.unknown if quality else "",
        queue=queue,
        latched=latched,
        callback=ctx.callbacks.give(callback),
        group=_group_name(group),
        conditions=tuple(dict.fromkeys(ctx.state.conditions)),
        asked=asked,
        through=through,
        overrides=_beyond(overrides, ctx.state.conditions) if node.generation == "ros2" else None,
    )
    for place, known in enumerate(node.endpoints):
        if (known.evidence, known.role, known.name, known.type) == (fact.evidence, role, fact.name, fact.type):
            node.endpoints[place] = _under_either(known, fact)
            return Made(node, place)
    node.endpoints.append(fact)
    return Made(node, len(node.endpoints) - 1)


def _under_either(known: EndpointFact, other: EndpointFact) -> EndpointFact:
    """Return an endpoint that is made at one place under these conditions or those."""
    if set(known.conditions) <= set(other.conditions):
        return known
    asked = tuple(one for one in known.asked if one in other.asked)
    return msgspec.structs.replace(known, conditions=under_either(known.conditions, other.conditions), asked=asked)


def _beyond(overrides: Overrides | None, conditions: list[Condition]) -> Overrides | None:
    """Return overrides without the conditions that hold for their endpoint anyway."""
    if overrides is None or not overrides.conditions:
        return overrides
    rest = tuple(dict.fromkeys(one for one in overrides.conditions if one not in conditions))
    return msgspec.structs.replace(overrides, conditions=rest)


def origin(ctx: Context, called: CallSite, name: Value) -> tuple[Evidence, tuple[Evidence, ...]]:
    """Return where an endpoint comes from: the call with its name, and the helpers that only pass it on."""
    evidence = called.evidence
    through: list[Evidence] = []
    expression = next(
        (one for one, value in zip(called.written, called.arguments, strict=False) if value is name), None
    )
    for site, function, written in reversed(ctx.stack.calls):
        passed = _passed_on(expression, function, written) if site.line else None
        if passed is None:
            break
        through.insert(0, evidence)
        expression, evidence = passed, site
    return evidence, tuple(through)


def _passed_on(expression: Expression | None, function: Function, written: tuple[Expression, ...]) -> Expression | None:
    """Return what a call gives for the parameter that an expression is, converted or not; None where it is none."""
    match expression:
        case Call(arguments=(only,)):
            return _passed_on(only, function, written)
        case Name(name=name):
            given = zip((parameter.name for parameter in function.parameters), written, strict=False)
            return next((one for parameter, one in given if parameter == name), None)
    return None


def sure_of(name: Text, receiver: Value) -> Sure:
    """Return how sure a name is: certain where it is written, likely where a parameter or guess decides."""
    if name.usual is None:
        return Sure.POSSIBLE
    return Sure.LIKELY if name.holes or is_guessed(receiver) else Sure.CERTAIN


def is_guessed(receiver: Value) -> bool:
    """Return whether it is not known of which node something is: the one that is built is taken for it."""
    match receiver:
        case None | Unknown():
            return True
    return False


def how(name: Text) -> str:
    """Return in words how a name was resolved."""
    if not name.holes:
        return _TAKEN
    return "; ".join(dict.fromkeys(str(hole.reason) for hole in name.holes))


def type_text(ctx: Context, kind: Value, generation: str, role: Role) -> Text:
    """Return the type of an endpoint as text."""
    match kind:
        case str():
            written = kind
        case Named() | Class():
            written = kind.name
        case Obj():
            written = kind.type
        case _:
            written = ""
    if not written:
        return unknown(reason_of(kind, "its type is not stated"))
    written = _adapted(ctx, written)
    name = _as_interface(written, generation)
    if not name:
        name = _as_interface(_meant(ctx, written), generation)
    if not name:
        name = included_interface(written, ctx.index.programs[ctx.state.frame.path])
    if not name:
        name = _in_scope(ctx, written, KINDS[role])
    if not name:
        name = lower_interface(written, ctx.index.contents.headers)
    return Text.of(of_generation(name, generation, KINDS[role])) if name else unknown(f"the type {written}")


def _meant(ctx: Context, written: str) -> str:
    """Return what a type means that is written by an alias or without its namespace."""
    path, scope = ctx.state.frame.path, ctx.state.frame.scope
    inner = message_of(written)
    plain = dotted(inner) if "<" not in inner else ""
    alias = ctx.index.alias(plain, path, scope) if plain else ""
    if "<" in alias:
        # A name for a pointer: ``typedef boost::shared_ptr<package::Message const> MessageConstPtr``.
        return alias
    meaning = ctx.index.meaning(plain or written.replace("::", "."), path, scope)
    if plain and meaning == plain and plain.isidentifier():
        # A class that stands for a message of any type: ``using namespace topic_tools; ShapeShifter``.
        defined = ctx.index.class_of(plain, path, scope)
        return meaning if defined is None else defined.what.qualified_name
    return meaning


def _as_interface(written: str, generation: str) -> str:
    """Return the name of an interface; those of ROS 2 are in a namespace of their own: what is not is a class."""
    name = interface_name(written)
    return "" if generation == "ros2" and name.count("/") == 1 and "/" not in written else name


def _adapted(ctx: Context, written: str) -> str:
    """Return the message that a type is adapted to: ``rclcpp::TypeAdapter<Custom, Message>``, or a registered class."""
    name, inside = type_name(written)
    if name == "rclcpp.TypeAdapter" and len(arguments := type_arguments(inside)) == 2:
        return arguments[1]
    if name.startswith("rclcpp.adapt_type") and "." in inside:
        return inside
    return ctx.index.adapted(name, ctx.state.frame.path, ctx.state.frame.scope) or written


def _in_scope(ctx: Context, written: str, kind: str) -> str:
    """Return the interface that a name without package means: of a module that is used whole, or of its namespace."""
    program = ctx.index.programs[ctx.state.frame.path]
    if not written.isidentifier():
        return ""
    if program.dialect.classes_in_modules:
        modules = [one for one in program.using if one.endswith(f".{kind}")]
        module = ctx.index.interfaces.of_modules(written, modules)
        return f"{module.replace('.', '/')}/{written}" if module else ""
    found = used_interface(written, kind, program.using, ctx.index.contents.headers)
    if found:
        return found
    scope = ctx.state.frame.scope
    while scope := scope.rpartition(".")[0]:
        last = scope.rpartition(".")[2]
        if ctx.index.contents.includes(f"{last}/{written}.h", ctx.state.frame.path):
            return f"{last}/{written}"
    return ""


def type_of_callback(callback: Value, place: int = 0) -> str:
    """Return the declared parameter type of a callback."""
    match callback:
        case Callable():
            bound = len(callback.arguments) - len(all_of_kind(callback.arguments, Unknown))
            parameters = callback.function.parameters[place + bound :]
            return parameters[0].type if parameters else ""
    return ""


class Described(Foreign, frozen=True):
    """The properties in the declaration of a parameter.

    See :class:`~roslens.source.extract.facts.node_facts.ParameterFact`.
    """

    range: str = ""
    description: str = ""
    terms: Terms = Terms()


_PLAIN = Described()
_TAKEN = "taken to be of this node"


def parameter(
    ctx: Context, receiver: Value, called: CallSite, access: str, name: Value, *,
    default: Value = None, kind: str = "", given: bool = False, described: Described = _PLAIN,
    evidence: Evidence | None = None,
) -> Value:  # fmt: skip
    """Record a parameter and return what reading it gives: a hole with its default, or what it is known to be."""
    node = node_of(ctx, receiver)
    written = below(receiver, as_text(name))
    text = _default_text(default) if given else None
    evidence = evidence or origin(ctx, called, name)[0]
    if is_guessed(receiver) and evidence.sure is Sure.CERTAIN:
        evidence = msgspec.structs.replace(evidence, how=_TAKEN, sure=Sure.LIKELY)
    fact = ParameterFact(
        written,
        evidence,
        access,
        kind or _type_by_default(node, default, python=called.evidence.path.endswith(".py")),
        text,
        described.range,
        tuple(dict.fromkeys(ctx.state.conditions)),
        described.description,
        terms=described.terms,
    )
    if fact not in node.parameters:
        node.parameters.append(fact)
    known = written.known or written.pattern
    stated = text if text is not None else declared_default(node, written)
    if ctx.given.chosen is not None:
        known = written.usual or known
        stated = declared_default(node, Text.of(known)) if stated is None else stated
        decided = chosen_value(ctx.given.chosen, node, known, stated)
        if decided is not None:
            return decided
    return _read(node, written, known, stated)


def _read(node: NodeBuilder, written: Text, known: str, stated: Text | None) -> Text:
    """Return what reading a parameter gives: a hole with the default that is stated."""
    usual = None if stated is None else stated.usual
    named = (written, *(() if stated is None else (stated,))) if written.holes else ()
    return Text((Hole(OfParameter(str(written), node.number), known, usual, named=named),))


def _default_text(default: Value) -> Text | None:
    match default:
        case None | Unknown() | Obj():
            return None
    return value_text(default)


def _type_by_default(node: NodeBuilder, default: Value, *, python: bool) -> str:
    """Return the type of a parameter by its default; what another parameter decides has the type of that one."""
    match default:
        case Text(only=Hole() as first):
            # It may be a number, too.
            named = (
                one for one in node.parameters if one.type and first.parameter in (one.name.known, one.name.pattern)
            )
            return next((one.type for one in named), "") if first.parameter else ""
        case Text() if default.holes:
            return "string"
    return type_of_value(default, python=python and node.generation == "ros2")


def is_set(value: Value) -> Condition | None:
    """Return what decides whether a parameter that was read is set; None where that is no question of its name."""
    match value:
        case Text(only=Hole(parameter=parameter)) if parameter and "*" not in parameter:
            return IsSet(value)
    return None


def value_text(value: Value) -> Text:
    """Return the value of a parameter as text: a list as YAML in one line, where all of it is known."""
    match value:
        case list():
            items = [value_text(one) for one in value]
            if any(one.known is None for one in items):
                return unknown("a list with unknown items")
            return Text.of("[", ", ".join(one.known or "''" for one in items), "]")
    return as_text(value)


def declared_default(node: NodeBuilder, name: Text) -> Text | None:
    """Return the default that a node declared for a parameter before."""
    for one in node.parameters:
        if one.name == name and one.default is not None:
            return one.default
    return None


def timer(ctx: Context, receiver: Value, called: CallSite, period: Value, callback: Value, group: Value) -> None:
    """Record a timer."""
    node = node_of(ctx, receiver)
    seconds = float(period) if is_number(period) else None
    node.timers.append(TimerFact(seconds, called.evidence, ctx.callbacks.give(callback), _group_name(group)))


def _group_name(group: Value) -> str:
    match group:
        case Group():
            return group.name
    return ""
