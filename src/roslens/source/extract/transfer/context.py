"""What meanings of calls and parts of the interpreter see of one evaluation: its state, and what they may ask of it.

The interpreter is made of parts that need each other; each knows this alone, so that none imports another that needs
it.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Protocol

from roslens.source.extract.domain.abstract_value import Building, Callable, Names, Obj, QosValue, Value
from roslens.source.extract.domain.call_stack import CallStack
from roslens.source.extract.domain.changed_in_ways import Changes
from roslens.source.extract.domain.evaluation_frame import Frame
from roslens.source.extract.domain.word_list import Words
from roslens.source.extract.facts.chosen import Chosen
from roslens.source.extract.facts.node_facts import Evidence
from roslens.source.extract.ir.dialect import Dialect
from roslens.source.extract.ir.program import Call, Expression, Function, Statement
from roslens.source.extract.symbolic.text import Condition, Text
from roslens.source.extract.symbols.reached_functions import Reached
from roslens.source.extract.symbols.workspace_index import Defined, Index
from roslens.source.extract.transfer.budget import Budget
from roslens.source.extract.transfer.named_functions import NamedFunctions


class Context(Protocol):
    """One evaluation of a unit.

    See :class:`~roslens.source.extract.interpreter.evaluation.Evaluation` for its attributes.
    """

    index: Index
    node: Building
    first: Building
    others: list[Building]
    made: list[Obj]
    chosen: Chosen | None
    plugin_names: Mapping[str, str]
    plugged: list[tuple[Obj, Building]]
    preparing: list[str]
    conditions: list[Condition]
    changes: Changes
    refined: dict[int, tuple[QosValue, QosValue]]
    frame: Frame
    globals: Names
    constants: dict[tuple[str, str], Value]
    once: dict[tuple[object, ...], Value]
    gave: tuple[Frame, Expression] | None
    bare: dict[int, tuple[Function, Function]]
    words: Words | None
    running: bool
    budget: Budget
    later: list[tuple[Callable, Condition | None]]
    reached: Reached
    site: Evidence
    written: tuple[Expression, ...]
    stack: CallStack
    named: NamedFunctions

    @property
    def dialect(self) -> Dialect:
        """The rules of the language of the function that is evaluated."""

    def value(self, expression: Expression) -> Value:
        """Return the value of an expression."""

    def member_of(self, of: Value, name: str, engine: Context) -> Value:
        """Return a member of a value by name."""

    def sum(self, one: Value, other: Value) -> Value:
        """Return two values added: texts one after the other."""

    def truth(self, value: Value) -> bool | None:
        """Return whether a value is true; None where that is unknown."""

    def items(self, value: Value) -> list[Value] | None:
        """Return what a loop goes through; None where it is unknown."""

    def made_outer(self, name: str, arguments: list[Value], keywords: Names, templates: tuple[str, ...]) -> Value:
        """Return an object of a class outside of the workspace."""

    def construct_outer(self, thing: Obj, name: str, arguments: list[Value], keywords: Names) -> None:
        """Construct a base of an object that is outside of the workspace."""

    def template(self, written: str) -> str:
        """Return a template argument with the template parameters around it replaced."""

    def constructed(self, declared: str, value: Value) -> Value:
        """Return a member that is initialised with one value: an object of its class made of it, or the value."""

    def construct(
        self, defined: Defined, arguments: list[Value], keywords: Names, templates: tuple[str, ...] = ()
    ) -> Value:
        """Make an object of a class of the workspace, its constructor evaluated."""

    def prepare(self, thing: Obj) -> None:
        """Give an object the members that its classes declare."""

    def construct_as(self, thing: Obj, defined: Defined, arguments: list[Value], keywords: Names) -> None:
        """Evaluate the constructor of one class of an object."""

    def base_constructed(self, thing: Obj, defined: Defined, arguments: list[Value], keywords: Names) -> None:
        """Construct the bases that are not in the workspace."""

    def declared(self, declared: str) -> Value:
        """Return the value of a declaration without one: an object of a class by value, else what is unknown."""

    def typed(self, declared: str, value: Value) -> Value:
        """Return a value as its declared type makes it: braces construct, numbers become texts of strings."""

    def converted(self, declared: str, value: Value) -> Value:
        """Return a value as a declaration makes it."""

    def of_type(self, name: str, arguments: list[Value], keywords: Names, templates: tuple[str, ...] = ()) -> Value:
        """Return an object of a class by its name as written."""

    def plain(self, name: str, arguments: list[Value]) -> Value:
        """Return a value of a fundamental type."""

    def frame_of(self, path: str, scope: str, thing: Value = None, names: Names | None = None) -> Frame:
        """Return the frame of a call that begins."""

    def as_returned(self, value: Value) -> Value:
        """Return a value as it is where a function returns it."""

    def at(self, call: Call) -> None:
        """Note which call is made next."""

    def touched(self) -> None:
        """Note that a word of the vocabulary is said, or a callback given away."""

    def forget_calls(self) -> None:
        """Note that what all functions see is changed: none does again what it did."""

    @property
    def touches(self) -> int:
        """How often a word of the vocabulary was said, or a callback given away."""

    def run_later(self) -> None:
        """Run the callbacks that were given away, once each, with arguments that are unknown."""

    def assign(self, target: Expression, value: Value) -> None:
        """Put a value where an expression says."""

    def under(self, condition: Condition, test: Condition | None = None) -> None:
        """Let a condition hold for what follows, until it is taken away again."""

    def asked_now(self) -> tuple[tuple[Condition, Condition], ...]:
        """Return those of the conditions that parameters decide."""

    def block(self, body: tuple[Statement, ...]) -> None:
        """Follow statements in order."""

    def further(self, evidence: Evidence, name: Text = ..., arguments: Sequence[Text] = ()) -> Building:
        """Return a further node of ROS 2 that is made."""

    def call(
        self,
        function: Callable,
        arguments: list[Value],
        keywords: Names,
        written: tuple[Expression, ...] = (),
        templates: tuple[str, ...] = (),
    ) -> Value:
        """Call a function of the workspace; ``written`` are the arguments as expressions, for references."""

    def written_at(self, line: int) -> None:
        """Note the line at which something is made next that no call makes."""

    def callable_type(self, function: Callable, place: int) -> str:
        """Return the declared type of a parameter of a callback; empty where it has none."""

    def called_outer(self, callback: Value, note: Condition | None = None) -> str:
        """Remember that a callback was given away; return its name."""
