"""What meanings of calls and parts of the interpreter see of one evaluation: its state, and what they may ask of it.

The interpreter is made of parts that need each other; each knows this alone, so that none imports another that needs
it.
"""

from __future__ import annotations

from collections.abc import Callable as Function1
from collections.abc import Mapping
from types import MappingProxyType
from typing import Protocol

import msgspec

from roslens.source.extract.domain.abstract_value import Invocation, Names, Obj, Value
from roslens.source.extract.domain.call_stack import CallStack
from roslens.source.extract.domain.callbacks import Callbacks
from roslens.source.extract.domain.emitter import Emitter
from roslens.source.extract.domain.state import State
from roslens.source.extract.domain.summaries import Summaries
from roslens.source.extract.domain.word_list import Words
from roslens.source.extract.facts.chosen import Chosen
from roslens.source.extract.ir.dialect import Dialect
from roslens.source.extract.ir.program import Call, Expression, Statement
from roslens.source.extract.symbols.symbol_table import Defined, SymbolTable
from roslens.source.extract.transfer.budget import Budget
from roslens.source.extract.transfer.named_functions import NamedFunctions


class Given(msgspec.Struct, frozen=True):
    """What is known of a unit before it is evaluated.

    Attributes:
        chosen: what is set that decides which plug-ins are loaded; None where that is not known yet.
        plugin_names: the class of each plug-in that has another name.
        words: of the command line, where they are known.
    """

    chosen: Chosen | None = None
    plugin_names: Mapping[str, str] = MappingProxyType({})
    words: Words | None = None


class ValuesOfExpressions(Protocol):
    """What expressions come to."""

    def defined(self, name: str) -> Value:
        """Return what the workspace defines under a name; None where it does not."""

    def member_of(self, of: Value, name: str) -> Value:
        """Return a member of a value by name."""

    def sum(self, one: Value, other: Value) -> Value:
        """Return two values added: texts one after the other."""

    def ways_of(self, value: Value) -> list[Value]:
        """Return the values of which a value is one, as far as it is known to be one of several."""


class ResultsOfCalls(Protocol):
    """What calls come to."""

    def called(self, expression: Call) -> Value:
        """Return the result of a call."""

    def made_outer(self, name: str, arguments: list[Value], keywords: Names, templates: tuple[str, ...]) -> Value:
        """Return an object of a class outside of the workspace."""

    def construct_outer(self, thing: Obj, name: str, arguments: list[Value], keywords: Names) -> None:
        """Construct a base of an object that is outside of the workspace."""

    def template(self, written: str) -> str:
        """Return a template argument with the template parameters around it replaced."""


class ObjectsOfTypes(Protocol):
    """What types make."""

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


class Context(Protocol):
    """One evaluation of a unit.

    Attributes:
        index: of the workspace.
        given: what is known of the unit before.
        state: where the evaluation stands.
        stack: of calls.
        budget: of steps.
        summaries: of calls that made nothing.
        callbacks: that were given away.
        emitter: of nodes.
        named: functions of the workspace by name.
        value: returns the value of an expression.
    """

    index: SymbolTable
    given: Given
    state: State
    stack: CallStack
    budget: Budget
    summaries: Summaries
    callbacks: Callbacks
    emitter: Emitter
    named: NamedFunctions
    value: Function1[[Expression], Value]

    @property
    def expressions(self) -> ValuesOfExpressions:
        """The part that evaluates expressions."""

    @property
    def calls(self) -> ResultsOfCalls:
        """The part that evaluates calls."""

    @property
    def objects(self) -> ObjectsOfTypes:
        """The part that makes objects and values of types."""

    @property
    def dialect(self) -> Dialect:
        """The rules of the language of the function that is evaluated."""

    def truth(self, value: Value) -> bool | None:
        """Return whether a value is true; None where that is unknown."""

    def items(self, value: Value) -> list[Value] | None:
        """Return what a loop goes through; None where it is unknown."""

    def call(self, call: Invocation) -> Value:
        """Return what a call of a function of the workspace returns."""

    def assign(self, target: Expression, value: Value) -> None:
        """Assign a value to the target of an expression."""

    def block(self, body: tuple[Statement, ...]) -> None:
        """Follow statements in order."""

    def run_later(self) -> None:
        """Run the callbacks that were given away, once each, with arguments that are unknown."""
