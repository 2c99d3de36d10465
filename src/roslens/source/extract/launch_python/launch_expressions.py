"""Expressions of launch files in Python: texts may be substitutions, and a choice keeps both of its values."""

from __future__ import annotations

from typing import Any

from roslens.source.extract.domain.abstract_value import Class, Named, Obj, Table, Unknown, Value
from roslens.source.extract.domain.guarded import guarded
from roslens.source.extract.interpreter.expressions import Expressions
from roslens.source.extract.interpreter.operations import opened
from roslens.source.extract.ir.program import Expression, Format, Item, Mapping, Member, Name, Opaque, Operation
from roslens.source.extract.ir.program import Sequence as Listed
from roslens.source.extract.launch_python.deferred import Deferred, Scope, resolve
from roslens.source.extract.launch_python.launch_action import text
from roslens.source.extract.launch_python.launch_functions import Bound
from roslens.source.extract.launch_python.launch_paths import CONSTANTS, member_of_path
from roslens.source.extract.launch_python.launch_values import Either, Made, as_value, lifted, plain
from roslens.source.extract.launch_python.launch_ways import either, kept
from roslens.source.extract.launch_python.launch_weight import bounded
from roslens.source.extract.launch_python.moveit_launches import is_configs, member_of_configs
from roslens.source.extract.launch_python.visit import Visit
from roslens.source.extract.symbolic.condition import negated
from roslens.source.extract.symbolic.text import Text, unknown
from roslens.source.extract.transfer.context import Context
from roslens.source.extract.transfer.spread_lists import spread_out

_MOST_TIMES = 100
_PLAIN = (str, bool, int, float, list, dict, type(None))


class LaunchExpressions(Expressions):
    """Values of expressions of a launch file."""

    def __init__(self, ctx: Context, visit: Visit) -> None:
        """Evaluate them while an action is visited, or the file is read."""
        super().__init__(ctx)
        self.visit = visit

    def outside(self, name: str) -> Value:
        """Return what a name means that is not of the file."""
        if name == "__file__":
            return Text.of(self.ctx.state.frame.path)
        if name in CONSTANTS:
            return Text.of(CONSTANTS[name])
        return Text.of("launch") if name == "__name__" else super().outside(name)

    def member_of(self, of: Value, name: str) -> Value:
        """Return a member of a value by name."""
        match of:
            case Text() | Deferred():
                found = member_of_path(of, name)
                return super().member_of(of, name) if found is None else lifted(found)
            case Obj() if is_configs(of):
                return member_of_configs(of, name)
            case Made() if of.name == "LaunchDescription" and name.startswith("add_"):
                return Bound(of, name)
            case Made() if name == "entities" and of.name == "LaunchDescription":
                return [item for one in of.positional for item in (self.ctx.items(one) or [one])]
            case list() if name in ("append", "extend"):
                return Bound(of, name)
            case Class():
                return self._member_of_class(of, name)
        return super().member_of(of, name)

    def _member_of_class(self, of: Class, name: str) -> Value:
        # An external class may define what a member means: ``Enum``.
        for one in self.ctx.index.chain(of.defined) if not self.ctx.index.outer_bases(of.defined) else ():
            found = super().member_of(Class(one), name)
            if not isinstance(found, Unknown):
                return found
        return Unknown(f"class {of.defined.what.qualified_name} of {of.defined.path}")

    def items(self, value: Value) -> list[Value] | None:
        """Return what a loop goes through; None where it is unknown."""
        match value:
            case Either():
                ways = ((value.one, value.condition), (value.other, negated(value.condition)))
                found = [self.items(one) for one, _ in ways]
                if None in found:
                    return None
                return [
                    one
                    for items, (_, held) in zip(found, ways, strict=True)
                    for one in guarded(items or [], held, None)
                ]
        return super().items(value)

    def truth(self, value: Value) -> bool | None:
        """Return whether a value is true; None where that is unknown."""
        return True if isinstance(value, Made) else super().truth(self.visit.performed(value))

    def sequence(self, expression: Listed) -> list[Value]:
        """Return a list."""
        return bounded(spread_out(self.ctx, expression))

    def mapping(self, expression: Mapping) -> Table:
        """Return a dictionary; keys may be substitutions."""
        found: Table = {}
        for key, value in expression.items:
            inner = self.value(value)
            if isinstance(key, Opaque) and key.text == "**":
                found.update(inner if isinstance(inner, dict) else {unknown("an unknown key"): inner})
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
        value = self.visit.performed(self.value(expression))
        if isinstance(value, Deferred) and value.kind != "environment":
            value = Unknown(f"a substitution in an f-string: {self.ctx.index.memo.text(expression)}")
        found = as_value(value)
        if isinstance(found, Deferred):
            found = resolve(found, Scope(_NO_FILES, {}, {}, self.visit.path))
        return found if isinstance(found, Text) else Text.of(found)

    def sum(self, one: Value, other: Value) -> Value:
        """Return two values added: texts and substitutions one after the other."""
        if isinstance(one, list) and isinstance(other, list):
            return bounded([*one, *(kept(self.ctx, one) for one in other)])
        if not isinstance(one, list) and (isinstance(one, Deferred) or isinstance(other, Deferred)):
            return bounded(lifted(text(as_value(one), as_value(other))))
        return super().sum(one, other)

    def ways_of(self, value: Value) -> list[Value]:
        """Return the values of which a value is one, as far as it is known to be one of several."""
        match value:
            case Either():
                return [*self.ways_of(value.one), *self.ways_of(value.other)]
        return [value]

    def item(self, expression: Item) -> Value:
        """Return an item."""
        of = self.value(expression.of) if isinstance(expression.of, Name | Member) else None
        if isinstance(of, Named) and of.name == "os.environ":
            return Deferred("environment", (as_value(self.value(expression.key)),))
        found = super().item(expression)
        return opened(self.ctx, expression) if isinstance(of, dict) and isinstance(found, Unknown) else found

    def either(self, expression: Operation, decides: Value) -> Value:  # noqa: ARG002 - nothing is asked of it
        """Return one of two values, or both with what decides."""
        then, otherwise = expression.operands[1:]
        condition = self.ctx.index.memo.condition(expression.operands[0])
        return either(self.value(then), self.value(otherwise), condition)

    def computed(self, operator: str, values: list[Value], expression: Operation) -> Value:
        """Return what an operator makes of values: ``/`` joins paths."""
        if operator == "/" and any(isinstance(one, Deferred | Text) for one in values):
            return self.visit.at_once(Deferred("path", tuple(as_value(plain(one)) for one in values)))
        match operator, values:
            case "|", [dict() as one, dict() as other]:
                return bounded({**one, **other})
            case "*", [list() as several, int() as times] if times <= _MOST_TIMES:
                return bounded(several * times)
            case "*", [Text(known=str(written)), int() as times] if times <= _MOST_TIMES:
                return Text.of(written * times)
        values = [self.visit.performed(one) for one in values]
        compare = _COMPARE.get(operator)
        if compare is None or len(values) != 2:
            return super().computed(operator, values, expression)
        one, other = map(plain, values)
        if not (_is_plain(one) and _is_plain(other)):
            return opened(self.ctx, expression)
        try:
            return bool(compare(one, other))
        except TypeError:
            return opened(self.ctx, expression)


def _is_plain(value: Any) -> bool:
    """Return whether all of a value is known."""
    match value:
        case list():
            return all(map(_is_plain, value))
        case dict():
            return all(_is_plain(one) for one in (*value, *value.values()))
    return isinstance(value, _PLAIN)


class _NoFiles:
    """No files at all."""

    def package(self, name: str) -> str | None:  # noqa: ARG002 - there is none
        return None

    def content(self, path: str) -> bytes | None:  # noqa: ARG002 - there is none
        return None

    def listing(self, folder: str) -> tuple[str, ...]:  # noqa: ARG002 - there are none
        return ()


_NO_FILES = _NoFiles()
_COMPARE: dict[str, Any] = {
    "==": lambda one, other: one == other,
    "!=": lambda one, other: one != other,
    "<": lambda one, other: one < other,
    ">": lambda one, other: one > other,
    "<=": lambda one, other: one <= other,
    ">=": lambda one, other: one >= other,
    "in": lambda one, other: one in other,
}
