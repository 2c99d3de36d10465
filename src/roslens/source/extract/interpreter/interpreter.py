"""Evaluates the programs of a workspace far enough to see which nodes, endpoints and parameters they make.

Statements are followed in order, calls into functions of the workspace with the values that are given, objects with
their members. What is not in the workspace is known by the vocabulary of ROS, or it is unknown. Both ways of an unknown
condition are followed; what is made there keeps it. Everything is bounded.
"""

from __future__ import annotations

from collections.abc import Callable as Function1

import msgspec

from roslens.source.extract.domain.abstract_value import Invocation, NodeBuilder, Value
from roslens.source.extract.domain.call_stack import CallStack
from roslens.source.extract.domain.callbacks import Callbacks
from roslens.source.extract.domain.emitter import Emitter
from roslens.source.extract.domain.frame import Frame
from roslens.source.extract.domain.state import State
from roslens.source.extract.domain.summaries import Summaries
from roslens.source.extract.facts.node_facts import Evidence
from roslens.source.extract.interpreter.assignments import assign
from roslens.source.extract.interpreter.calls import Calls
from roslens.source.extract.interpreter.expressions import Expressions
from roslens.source.extract.interpreter.functions import Functions
from roslens.source.extract.interpreter.objects import Objects
from roslens.source.extract.interpreter.statements import block
from roslens.source.extract.ir.dialect import Dialect
from roslens.source.extract.ir.program import Expression, Statement
from roslens.source.extract.symbols.symbol_table import SymbolTable
from roslens.source.extract.transfer.budget import Budget
from roslens.source.extract.transfer.context import Context, Given
from roslens.source.extract.transfer.named_functions import NamedFunctions

NOTHING_GIVEN = Given()


class Parts(msgspec.Struct, frozen=True):
    """What makes the parts of an interpreter: programs of a kind of their own have others.

    Attributes:
        expressions: makes the part that evaluates expressions.
        calls: makes the part that evaluates calls.
    """

    expressions: Function1[[Context], Expressions] = Expressions
    calls: Function1[[Context], Calls] = Calls


USUAL = Parts()


class Interpreter:
    """One evaluation of a unit: a main function, a class that becomes a node, a module.

    It owns what an evaluation knows and the parts that evaluate, and is the :class:`Context` by which each part
    reaches the others. See there for its attributes.
    """

    def __init__(
        self,
        index: SymbolTable,
        node: NodeBuilder,
        given: Given = NOTHING_GIVEN,
        *,
        parts: Parts = USUAL,
        state: State | None = None,
        budget: Budget | None = None,
    ) -> None:
        """Begin outside of functions.

        Args:
            index: of the workspace.
            node: that is built.
            given: what is known of the unit before.
            parts: that evaluate.
            state: to begin in.
            budget: of steps.
        """
        self.index = index
        self.given = given
        self.state = state or State(Frame(node.path, ""), Evidence(node.path, node.line))
        self.stack = CallStack()
        self.budget = budget or Budget()
        self.summaries = Summaries()
        self.callbacks = Callbacks(self.summaries)
        self.emitter = Emitter(node)
        self.named = NamedFunctions(self)
        self.functions = Functions(self)
        self.objects = Objects(self)
        self.calls = parts.calls(self)
        self.expressions = parts.expressions(self)
        self.value: Function1[[Expression], Value] = self.expressions.value

    @property
    def dialect(self) -> Dialect:
        """The rules of the language of the function that is evaluated."""
        return self.index.programs[self.state.frame.path].dialect

    def truth(self, value: Value) -> bool | None:
        """Return whether a value is true; None where that is unknown."""
        return self.expressions.truth(value)

    def items(self, value: Value) -> list[Value] | None:
        """Return what a loop goes through; None where it is unknown."""
        return self.expressions.items(value)

    def call(self, call: Invocation) -> Value:
        """Return what a call of a function of the workspace returns."""
        return self.functions.call(call)

    def assign(self, target: Expression, value: Value) -> None:
        """Put a value where an expression says."""
        assign(self, target, value)

    def block(self, body: tuple[Statement, ...]) -> None:
        """Follow statements in order."""
        block(self, body)

    def run_later(self) -> None:
        """Run the callbacks that were given away, once each, with arguments that are unknown."""
        callbacks, conditions = self.callbacks, self.state.conditions
        while callbacks.waiting:
            callback, note = callbacks.waiting.pop(0)
            key = (callback.path, callback.function.line)
            if key not in callbacks.reached:
                with_note = [] if note is None else [note]
                conditions += with_note
                before, callbacks.running = callbacks.running, True
                self.call(Invocation(callback))
                callbacks.running = before
                del conditions[len(conditions) - len(with_note) :]
