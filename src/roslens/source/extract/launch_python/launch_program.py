"""A launch file in Python, evaluated by the interpreter that follows nodes, over what launch and launch_ros mean.

Calls that are not known here are unknown values. Both ways of an open condition are followed, and what is made there
keeps the condition. Of two values that a condition chooses neither is taken for the other, as the interpreter does with
objects of nodes: :class:`~roslens.source.extract.launch_python.launch_values.Either` has both.
"""

from __future__ import annotations

from typing import Any

from roslens.source.extract.domain.abstract_value import (
    Building,
    Callable,
    Class,
    Named,
    Names,
    Obj,
    Table,
    Unknown,
    Value,
)
from roslens.source.extract.domain.changed_in_ways import Changes
from roslens.source.extract.domain.evaluation_frame import Frame, Held
from roslens.source.extract.domain.evaluation_frame import join as join_names
from roslens.source.extract.domain.perhaps import Perhaps, perhaps
from roslens.source.extract.facts.files import Files
from roslens.source.extract.facts.node_facts import Evidence
from roslens.source.extract.interpreter.evaluated_operations import opened
from roslens.source.extract.interpreter.evaluation import Evaluation
from roslens.source.extract.interpreter.vocabulary_index import indexed
from roslens.source.extract.ir.program import Call, Expression, Format, Item, Mapping, Member, Name, Opaque, Operation
from roslens.source.extract.ir.program import Sequence as Listed
from roslens.source.extract.launch_python.deferred import Deferred, Scope, resolve
from roslens.source.extract.launch_python.launch_action import text, unknown_value
from roslens.source.extract.launch_python.launch_file_reads import READS, Opened, read
from roslens.source.extract.launch_python.launch_sources import AsWritten, programs_of
from roslens.source.extract.launch_python.launch_values import Either, Made, as_value, lifted, plain
from roslens.source.extract.launch_python.launch_weight import bounded
from roslens.source.extract.launch_python.launch_words import ACTIONS, call_known, call_method, is_known
from roslens.source.extract.symbolic.condition import all_of, negated
from roslens.source.extract.symbolic.text import Condition, Text
from roslens.source.extract.transfer.budget import Budget
from roslens.source.extract.transfer.spread_lists import spread_out

MOST_STEPS = 300_000
MOST_FRAMES = 25
MOST_TURNS = 1_000
_PLAIN = (str, bool, int, float, list, dict, type(None))
_SIMPLE = (Text, Unknown, bool, int, float, type(None))
_TEXTS = (Text, Deferred, Opened)
_ADDING = frozenset({"append", "extend"})


class LaunchProgram(Evaluation):
    """An evaluation of a launch file.

    Attributes:
        scope: of the action that is visited, where a function is called by one; None while the file is read.
    """

    def __init__(self, path: str, content: bytes, files: Files | None = None) -> None:
        """Read the file, and what it imports of the workspace."""
        programs, places = programs_of(path, content, files)
        # What a launch file imports it sees, whichever package has it.
        index = indexed(programs, dict.fromkeys(programs, "launch"))
        index.lookups = AsWritten(places)
        unit = Building("<launch>", path, 1, "ros2", parameters=[], endpoints=[], unresolved=[])
        super().__init__(index, unit)
        self.budget = Budget(MOST_STEPS, MOST_FRAMES, MOST_TURNS, MOST_TURNS)
        self.changes = LaunchChanges()
        self.refined = self.changes.refined
        self.path = path
        self.files = files
        self.scope: Scope | None = None
        self.frame = LaunchFrame(path, "")

    def entry(self, name: str) -> Callable | None:
        """Return a function of the file."""
        return self.named.function(name, 0)

    def run(self, function: Callable, arguments: list[Value], keywords: Names, scope: Scope | None = None) -> Value:
        """Call a function; what it returns may be unknown.

        Raises:
            SpentError: the bounds are spent.
        """
        outer, self.scope = self.scope, scope or self.scope
        try:
            return self.call(function, arguments, keywords)
        finally:
            self.scope = outer
            self.frame = LaunchFrame(self.path, "")
            self.conditions.clear()

    def frame_of(self, path: str, scope: str, thing: Value = None, names: Names | None = None) -> Frame:
        """Return the frame of a call that begins."""
        return LaunchFrame(path, scope, thing, names)

    def as_returned(self, value: Value) -> Value:
        """Return a value as it is now: where a function may go on, what it returned is not changed by what follows."""
        if len(self.conditions) == self.frame.depth:
            return value
        match value:
            case list():
                return list(value)
            case Made():
                return Made(value.name, value.evidence, list(value.positional), value.named, value.conditions)
        return value

    # Names

    def _outside(self, name: str) -> Value:
        if name == "__file__":
            return Deferred("file")
        return Text.of("launch") if name == "__name__" else super()._outside(name)

    def member(self, expression: Member) -> Value:
        """Return a member of an object, or what a module of the workspace has."""
        of = self.value(expression.of)
        found = self.defined(_dotted(expression)) if isinstance(of, Named) else None
        return self.member_of(of, expression.name, self) if found is None else found

    def member_of(self, of: Value, name: str, engine: Any) -> Value:
        """Return a member of a value by name."""
        if not isinstance(of, Class):
            return super().member_of(of, name, engine)
        # A class from outside may say what a member means: ``Enum``.
        for one in self.index.chain(of.defined) if not self.index.outer_bases(of.defined) else ():
            found = super().member_of(Class(one), name, engine)
            if not isinstance(found, Unknown):
                return found
        return Unknown(f"class {of.defined.what.qualified_name} of {of.defined.path}")

    # Expressions

    def performed(self, value: Value) -> Value:
        """Return a substitution as what it comes to for the action that is visited, where that is known."""
        if not isinstance(value, Deferred | Text) or self.scope is None:
            return value
        return resolve(value, self.scope)

    def truth(self, value: Value) -> bool | None:
        """Return whether a value is true; None where that is unknown."""
        return True if isinstance(value, Made) else super().truth(self.performed(value))

    def sequence(self, expression: Listed) -> list[Value]:
        """Return a list."""
        return bounded(spread_out(self, expression))

    def mapping(self, expression: Mapping) -> Table:
        """Return a dictionary; keys may be substitutions."""
        found: Table = {}
        for key, value in expression.items:
            inner = self.value(value)
            if isinstance(key, Opaque) and key.text == "**":
                found.update(inner if isinstance(inner, dict) else {})
                continue
            name: Any = self.value(key)
            name = text(*map(as_value, name)) if isinstance(name, list) else name
            if isinstance(name, Text | int | float | Deferred | str):
                held: Any = lifted(name)
                found[held] = inner
        return bounded(found)

    def format(self, expression: Format) -> Text:
        """Return a text put together."""
        return Text.of(*(self._piece(one) for one in expression.parts))

    def _piece(self, expression: Expression) -> Text:
        value = self.performed(self.value(expression))
        if isinstance(value, Deferred):
            value = Unknown(f"a substitution in an f-string: {self.index.lookups.text(expression)}")
        found = as_value(value)
        if isinstance(found, Deferred):
            found = resolve(found, Scope(_NO_FILES, {}, {}, self.path))
        return found if isinstance(found, Text) else Text.of(found)

    def sum(self, one: Value, other: Value) -> Value:
        """Return two values added: texts and substitutions one after the other."""
        if isinstance(one, list) and isinstance(other, list):
            return bounded([*one, *map(self.kept, other)])
        if not isinstance(one, list) and (isinstance(one, Deferred) or isinstance(other, Deferred)):
            return bounded(lifted(text(as_value(one), as_value(other))))
        return super().sum(one, other)

    def item(self, expression: Item) -> Value:
        """Return an item."""
        of = self.value(expression.of) if isinstance(expression.of, Name | Member) else None
        if isinstance(of, Named) and of.name == "os.environ":
            return Deferred("environment", (as_value(self.value(expression.key)),))
        found = super().item(expression)
        return opened(self, expression) if isinstance(of, dict) and isinstance(found, Unknown) else found

    def _either(self, expression: Operation, decides: Value) -> Value:  # noqa: ARG002 - nothing is asked of it
        then, otherwise = expression.operands[1:]
        condition = self.index.lookups.condition(expression.operands[0])
        return either(self.value(then), self.value(otherwise), condition)

    def _computed(self, operator: str, values: list[Value], expression: Operation) -> Value:
        if operator == "/" and any(isinstance(one, Deferred | Text) for one in values):
            return Deferred("path", tuple(map(as_value, values)))
        values = [self.performed(one) for one in values]
        compare = _COMPARE.get(operator)
        if compare is None or len(values) != 2:
            return super()._computed(operator, values, expression)
        one, other = map(plain, values)
        if not (_is_plain(one) and _is_plain(other)):
            return opened(self, expression)
        try:
            return bool(compare(one, other))
        except TypeError:
            return opened(self, expression)

    # Calls

    def called(self, expression: Call) -> Value:
        """Return the result of a call."""
        if expression.function == _STR and len(expression.arguments) == 1 and "str" not in self.frame.names:
            return lifted(as_value(self.value(expression.arguments[0])))
        return super().called(expression)

    def outer(
        self, name: str, expression: Call, arguments: list[Value], keywords: Names, templates: tuple[str, ...]
    ) -> Value:
        """Return the result of calling something outside of the workspace."""
        self.touched()
        last = name.rpartition(".")[2]
        given = {one: value for one, value in keywords.items() if one != "**"}
        if last in ACTIONS:
            first = arguments[0] if arguments else None
            if last == "LaunchDescription" and isinstance(first, list):
                arguments = [list(first), *arguments[1:]]
            place = Evidence(self.frame.path, expression.line, expression.column)
            return Made(last, place, list(arguments), given, tuple(dict.fromkeys(self.conditions)))
        if name not in READS and not is_known(name):
            return super().outer(name, expression, arguments, keywords, templates)
        positional = [plain(one) for one in arguments]
        if name in READS:
            return lifted(read(name, positional, self.frame.path, self.files, self.scope))
        return lifted(call_known(name, positional, {one: plain(value) for one, value in given.items()}))

    def _plain_method(
        self, expression: Call, function: Member, of: Value, arguments: list[Value], keywords: Names
    ) -> Value:
        self.touched()
        name = function.name
        if name == "perform" and isinstance(of, Deferred | Text | Made):
            return lifted(self._resolved(as_value(of)))
        match of:
            case Made() if of.name == "LaunchDescription" and name.startswith("add_"):
                self.changes.items(of.positional)
                of.positional.append([self.kept(one) for one in arguments])
                return None
            case list() if name in _ADDING:
                added = arguments[0] if name == "extend" and arguments and isinstance(arguments[0], list) else arguments
                arguments = [[self.kept(one) for one in added]]
                return super()._plain_method(expression, Member(function.of, "extend"), of, arguments, keywords)
            case list() | dict() if name == "copy":
                return of.copy()
            case dict() if name in ("get", "pop") and len(arguments) == 1:
                arguments = [*arguments, None]
            case _ if isinstance(of, _TEXTS):
                given = {one: plain(value) for one, value in keywords.items()}
                written = self.index.lookups.text(expression.function)
                return lifted(call_method(plain(of), name, [plain(one) for one in arguments], given, written))
        return super()._plain_method(expression, function, of, arguments, keywords)

    def _resolved(self, value: Deferred | Text | str) -> Deferred | Text | str:
        return value if self.scope is None else resolve(value, self.scope)

    def kept(self, value: Value) -> Value:
        """Return a value that a list gets: it has it if what is around now holds, wherever it was made."""
        around = tuple(one for one in dict.fromkeys(self.conditions) if one not in _conditions(value))
        return Perhaps(value, all_of(around)) if around and isinstance(value, Made) else value


class LaunchChanges(Changes):
    """What ways change in lists and tables of a launch file."""

    def joined(self, one: list[Value], other: list[Value], condition: Condition, test: Condition | None) -> Value:
        """Return what is known of two lists of which a condition chooses; None where either may stand."""
        found = joined(one, other, condition)
        return super().joined(one, other, condition, test) if found is None else found


class LaunchFrame(Frame):
    """One call of a function of a launch file."""

    def join(self, other: Held, condition: Condition) -> None:
        """Let names hold what either way of a condition came to, ``other`` being that where it is true."""
        for name, value in other[0].items():
            self.names[name] = either(value, self.names.get(name, value), condition)
        if isinstance(self.self, Obj):
            join_names(self.self.fields, other[1], condition)

    def _or_else(self, value: Value, given: Condition) -> Value:
        return either(self.result, value, given)


def either(one: Value, other: Value, condition: Condition) -> Value:
    """Return the value that is one where a condition holds, and the other one where it does not."""
    if one is other or (type(one) is type(other) and isinstance(one, _SIMPLE) and one == other):
        return one
    if isinstance(one, list) and isinstance(other, list):
        both = joined(one, other, condition)
        if both is not None:
            return both
    return Either(condition, one, other)


def joined(one: list[Value], other: list[Value], condition: Condition) -> list[Value] | None:
    """Return a list of which some items are there under a condition, or its opposite; None where it has others."""
    same = 0
    while same < min(len(one), len(other)) and one[same] is other[same]:
        same += 1
    if not all(isinstance(item, Made | Perhaps) for item in (*one[same:], *other[same:])):
        return None
    then, otherwise = perhaps(one[same:], condition, None), perhaps(other[same:], negated(condition), None)
    return [*one[:same], *then, *otherwise]


def _conditions(value: Value) -> tuple[Condition, ...]:
    return value.conditions if isinstance(value, Made) else ()


def _is_plain(value: Any) -> bool:
    """Return whether all of a value is known."""
    match value:
        case list():
            return all(map(_is_plain, value))
        case dict():
            return all(_is_plain(one) for one in (*value, *value.values()))
    return isinstance(value, _PLAIN)


def _dotted(expression: Expression) -> str:
    match expression:
        case Name():
            return expression.name
        case Member():
            before = _dotted(expression.of)
            return f"{before}.{expression.name}" if before else ""
    return ""


class _NoFiles:
    """No files at all."""

    def package(self, name: str) -> str | None:  # noqa: ARG002 - there is none
        return None

    def content(self, path: str) -> bytes | None:  # noqa: ARG002 - there is none
        return None


_NO_FILES = _NoFiles()
_STR = Name("str")
_COMPARE: dict[str, Any] = {
    "==": lambda one, other: one == other,
    "!=": lambda one, other: one != other,
    "<": lambda one, other: one < other,
    ">": lambda one, other: one > other,
    "<=": lambda one, other: one <= other,
    ">=": lambda one, other: one >= other,
    "in": lambda one, other: one in other,
}
__all__ = ["Either", "LaunchProgram", "Made", "either", "unknown_value"]
