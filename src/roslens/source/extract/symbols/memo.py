"""What was looked up before: of the names in a class or at a place, and of expressions as text.

An evaluation asks the same again and again, as functions are followed from many places; what an index says never
changes. Classes and expressions are known by identity here, which is a lot cheaper than by value: the programs of the
index, or what is kept beside it, hold each of them, so that no other gets its number.
"""

from __future__ import annotations

from typing import Any

from roslens.source.extract.ir.makes_endpoints import calls_that_make
from roslens.source.extract.ir.program import NO_EXCEPTION, Call, Expression, Field, Function, Operation, Statement
from roslens.source.extract.ir.program_text import expression_text
from roslens.source.extract.symbolic.condition import all_of, any_of, negated
from roslens.source.extract.symbolic.text import Condition, NoException, Written

_LOGIC = frozenset({"and", "or", "not"})
Found = tuple[Function, str] | None
"""A function and the path of its file."""


class Whole:
    """What is known of all programs of an index together.

    Attributes:
        set_on_classes: attributes that code of Python sets on classes, by the last name of the class; None before it
            is asked for.
        function_names: of all functions with a body; None before it is asked for.
    """

    def __init__(self) -> None:
        """Begin with nothing."""
        self.set_on_classes: set[tuple[str, str]] | None = None
        self.function_names: set[str] | None = None


class Memo:
    """What an index said.

    Attributes:
        method: of a class, by identity and name.
        overloads: of a class, by identity, name and how many arguments are given.
        alone: those of ``overloads`` that no arguments decide, as there is one of the name only.
        functions: outside of classes, by name, path, scope and how many arguments are given.
        defined: what a name stands for in a class (0 outside), by name, path and scope.
        outside: what a called name means that nothing in the workspace has, and what it is an alias of, by class, name,
            path, scope and how many arguments are given.
        kinds: what objects are, by their type, class and whether they are nodes.
        members: of objects of a class, by its identity, with what they are at first.
        of_modules: statements that change variables of modules of Python, by path and name.
        whole: what is known of all programs together.
        called: last names of what an expression calls, by its identity, with it.
        set_in_turns: members that methods set which a loop calls, by its identity and that of a class, with it.
        texts: expressions as text, by their identity, with them.
        conditions: expressions as conditions, likewise.
        making: calls in a function that make an endpoint by their name, by its identity, with it.
    """

    def __init__(self, beside: Memo | None = None) -> None:
        """Begin with nothing, or with what a memo for the same programs knows that depends on no name.

        Args:
            beside: that other memo; both share what is learned of single expressions and of all programs together.
        """
        self.method: dict[tuple[int, str], Found] = {}
        self.overloads: dict[tuple[int, str, int], Found] = {}
        self.alone: set[tuple[int, str, int]] = set()
        self.functions: dict[tuple[str, str, str, int], Found] = {}
        self.defined: dict[tuple[int, str, str, str], tuple[str, Any, Any]] = {}
        self.kinds: dict[tuple[str, int, bool], tuple[str, ...]] = {}
        self.outside: dict[tuple[int, str, str, str, int], tuple[str, str]] = {}
        self.members: dict[int, tuple[tuple[Field, Any], ...]] = {}
        self.of_modules: dict[str, dict[str, tuple[Statement, ...]]] = {}
        self.set_in_turns: dict[tuple[int, int], tuple[Statement, tuple[str, ...]]] = {}
        self.whole: Whole = Whole() if beside is None else beside.whole
        self.called: dict[int, tuple[Expression, tuple[str, ...]]] = {} if beside is None else beside.called
        self.making: dict[int, tuple[Function, tuple[Call, ...]]] = {} if beside is None else beside.making
        self.texts: dict[int, tuple[Expression, str]] = {} if beside is None else beside.texts
        self.conditions: dict[int, tuple[Expression, Condition]] = {} if beside is None else beside.conditions

    def calls_that_make(self, function: Function) -> tuple[Call, ...]:
        """Return the calls in a function that make an endpoint, by their name."""
        known = self.making.get(id(function))
        if known is None or known[0] is not function:
            found = tuple(calls_that_make(function.initialisers, function.body))
            known = self.making[id(function)] = (function, found)
        return known[1]

    def text(self, expression: Expression) -> str:
        """Return an expression of a program as text."""
        known = self.texts.get(id(expression))
        if known is None or known[0] is not expression:
            known = self.texts[id(expression)] = (expression, expression_text(expression))
        return known[1]

    def condition(self, expression: Expression) -> Condition:
        """Return a condition of a program, looked into as far as ``and``, ``or`` and ``not`` go."""
        known = self.conditions.get(id(expression))
        if known is None or known[0] is not expression:
            known = self.conditions[id(expression)] = (expression, self._condition(expression))
        return known[1]

    def _condition(self, expression: Expression) -> Condition:
        if expression == NO_EXCEPTION:
            return NoException()
        match expression:
            case Operation(operator="not", operands=(one,)):
                return negated(self._condition(one))
            case Operation(operator="and", operands=(_, _, *_)):
                return all_of([self._condition(one) for one in expression.operands])
            case Operation(operator="or", operands=(_, _, *_)):
                return any_of(*(self._condition(one) for one in expression.operands))
            case Operation():
                # Without the brackets around.
                return Written(self.text(expression)[1:-1])
        return Written(self.text(expression).strip("`"))
