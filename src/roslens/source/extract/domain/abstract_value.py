"""Values while source is evaluated: texts that may have holes, objects with members, and what ROS gives out.

Numbers, truth values and None are themselves; texts are :class:`~roslens.source.extract.symbolic.text.Text`.
"""

from __future__ import annotations

from typing import TypeAlias, TypeVar

import msgspec

from roslens.model.qos import Qos
from roslens.source.extract.facts.node_facts import (
    EndpointFact,
    Evidence,
    Inherits,
    LoadFact,
    NodeFacts,
    Overrides,
    ParameterFact,
    PluginFact,
    TimerFact,
    with_texts,
)
from roslens.source.extract.ir.program import Expression, Function
from roslens.source.extract.symbolic.reason import (
    FIRST,
    MAKER,
    EachOf,
    ItemOf,
    NamePart,
    OfHandle,
    OfNode,
    OfParameter,
    Reason,
    for_node,
    node_of_reason,
)
from roslens.source.extract.symbolic.text import Condition, Conditions, Hole, IsTrue, Text, unknown
from roslens.source.extract.symbols.symbol_table import Defined

_Kind = TypeVar("_Kind")
_TypeOf: TypeAlias = type[_Kind]


class Unknown(msgspec.Struct, frozen=True):
    """A value of which nothing is known but why; ``test`` is what decides whether it is true, where that is known."""

    reason: Reason
    test: Condition | None = None


class NodeBuilder(msgspec.Struct, eq=False):
    """The facts of a node while they are collected.

    ``number`` counts the nodes that one evaluation makes; 0 is the first one.
    """

    unit: str
    path: str
    line: int
    generation: str
    kind: str = "node"
    name: Text = Text()
    namespace: Text = Text()
    endpoints: list[EndpointFact] = []
    parameters: list[ParameterFact] = []
    timers: list[TimerFact] = []
    arguments: list[Text] = []
    settings: list[tuple[Text, Text]] = []
    global_arguments: bool = True
    inherits: Inherits = Inherits.NOTHING
    conditions: Conditions = ()
    options: Value = None
    number: int = 0
    uses: list[str] = []
    unresolved: list[tuple[Evidence, str]] = []
    loads: list[LoadFact] = []
    named: bool = False
    declares_set: bool = False
    doubt: str = ""
    plugins: list[PluginFact] = []
    asks: list[Text] = []

    def facts(self) -> NodeFacts:
        """Return what was collected."""
        facts = NodeFacts(
            self.unit, self.path, self.line, self.generation, self.kind, self.name, self.namespace,
            tuple(self.endpoints), tuple(self.parameters), tuple(self.timers), tuple(self.arguments),
            tuple(self.settings), self.global_arguments, self.inherits, self.conditions, self.number,
            tuple(dict.fromkeys(self.uses)), tuple(dict.fromkeys(self.unresolved)), tuple(self.loads),
            self.declares_set, self.doubt, tuple(self.plugins), tuple(self.asks),
        )  # fmt: skip
        return with_texts(facts, self._seen_from_here) if self.number else facts

    def of_name(self, what: NamePart) -> OfNode:
        """Return the reason of a hole that a part of the name of this node fills."""
        return OfNode(what, self.number)

    def _seen_from_here(self, text: Text) -> Text:
        """Return a text with holes that this node fills as such, and those of the first one as of another."""
        return text.mapped(self._hole)

    def _hole(self, hole: Hole) -> Hole:
        reason, number = hole.reason, node_of_reason(hole.reason)
        match reason:
            case EachOf() | ItemOf():
                own = number == self.number
                reason = for_node(reason, FIRST) if own else reason
                return msgspec.structs.replace(hole, reason=reason, parameter=hole.parameter * own)
            case OfNode() | OfParameter() | OfHandle(of=OfNode()):
                whose = {self.number: FIRST, FIRST: MAKER}.get(number, number)
                return msgspec.structs.replace(hole, reason=for_node(reason, whose))
        return hole


class Obj(msgspec.Struct, eq=False):
    """An object: of a class of the workspace, or of one that is known by name only.

    Attributes:
        type: qualified name of its class, joined by ``.``.
        defined: the class, where it is in the workspace.
        fields: its members.
        node: of the node that it is, where it is one.
        templates: what the template parameters of its class stand for.
        base_templates: those of its bases, by the qualified name of the base.
        ways: the objects of which it is one, each with its conditions; empty of one object.
    """

    type: str
    defined: Defined | None = None
    fields: Names = {}
    node: NodeBuilder | None = None
    templates: dict[str, str] = {}
    base_templates: dict[str, dict[str, str]] = {}
    ways: tuple[tuple[Conditions, Obj], ...] = ()

    def held(self, name: str, kind: _TypeOf[_Kind]) -> _Kind | None:
        """Return what a member holds where that is of a kind; None where it holds anything else."""
        value = self.fields.get(name)
        return value if isinstance(value, kind) else None

    def templates_of(self, class_name: str) -> dict[str, str]:
        """Return what the template parameters stand for in its class, or in a base of it."""
        return self.base_templates.get(class_name, self.templates)


class Handle(msgspec.Struct, frozen=True, eq=False):
    """Something names are resolved against: a NodeHandle of ROS 1, a node interface or sub-node of ROS 2."""

    node: NodeBuilder
    prefix: Text = Text()


class Made(msgspec.Struct, frozen=True, eq=False):
    """An endpoint that was made: its node and its place in the node's list, and whether it was made for sure."""

    node: NodeBuilder
    place: int
    certain: bool = True


class QosValue(msgspec.Struct, frozen=True):
    """A quality of service, and the reason where a part of it is unknown."""

    qos: Qos = Qos()
    unknown: str = ""


class Group(msgspec.Struct, frozen=True):
    """A callback group by the name of what holds it."""

    name: str


class Callable(msgspec.Struct, frozen=True, eq=False):
    """A function of the workspace, with the object and the names it is bound to."""

    function: Function
    path: str
    self: Value = None
    names: Names | None = None
    arguments: tuple[Value, ...] = ()


class Invocation(msgspec.Struct, frozen=True, eq=False):
    """A call of a function of the workspace.

    Attributes:
        function: that is called.
        arguments: values by position.
        keywords: values by name.
        written: the arguments by position as expressions, for references.
        templates: template arguments, as written.
    """

    function: Callable
    arguments: list[Value] = []
    keywords: Names = {}
    written: tuple[Expression, ...] = ()
    templates: tuple[str, ...] = ()


class Named(msgspec.Struct, frozen=True):
    """Something outside of the workspace by its whole name: a class, function or constant."""

    name: str
    templates: tuple[str, ...] = ()


class Remappings(dict["Key", "Value"]):
    """A map of names to names, as node handles take remappings."""


class Class(msgspec.Struct, frozen=True, eq=False):
    """A class of the workspace as a value."""

    defined: Defined

    @property
    def name(self) -> str:
        """Its qualified name."""
        return self.defined.what.qualified_name


class Foreign(msgspec.Struct, frozen=True):
    """A value that one part of the interpreter or one overlay keeps; to others it is one of which nothing is known."""


Value: TypeAlias = (
    "bool | int | float | str | Text | Unknown | Obj | Handle | Made | QosValue | Group | Callable | Named | Class"
    " | Overrides | Inherits | Foreign | list[Value] | tuple[Value, ...] | dict[Key, Value] | None"
)
"""All that an expression may come to: closed, so that what is not handled is found by the type checker.

``str`` is the written form of a template argument, a tuple what is kept of several values.
"""
Key: TypeAlias = bool | int | float | str | Text | None
"""Under which a table holds a value: see :func:`~roslens.source.extract.domain.table_key.hashable`."""
Table: TypeAlias = "dict[Key, Value]"
Names: TypeAlias = "dict[str, Value]"


def test_of(value: Value) -> Condition | None:
    """Return what decides whether a value is true; None where nothing that is known does."""
    match value:
        case Unknown():
            return value.test
        case Text() if value.holes:
            return IsTrue(value)
    return None


def as_text(value: Value) -> Text:
    """Return a value as text; what is none is a hole with the reason."""
    match value:
        case Text():
            return value
        case Unknown():
            return unknown(value.reason)
        case bool():
            return Text.of("true" if value else "false")
        case int() | float():
            return Text.of(str(value))
        case Named():
            return unknown(f"the value of {value.name}")
        case Obj():
            return unknown(f"a {value.type}")
    return unknown("a value that is not a string")
