"""Expressions while source is evaluated."""

from __future__ import annotations

from collections.abc import Callable as Function1
from typing import TYPE_CHECKING, Any

from roslens.source.extract.domain.abstract_value import (
    Callable,
    Class,
    Invocation,
    Made,
    Named,
    Obj,
    Table,
    Unknown,
    Value,
    as_text,
    test_of,
)
from roslens.source.extract.domain.frame import Frame
from roslens.source.extract.domain.guarded import Guarded, unguarded
from roslens.source.extract.domain.list_slices import is_slice, part_of
from roslens.source.extract.domain.plain_methods import SAME
from roslens.source.extract.domain.table_key import hashable
from roslens.source.extract.domain.unknown_lists import item_of
from roslens.source.extract.domain.word_list import has_place
from roslens.source.extract.interpreter.dotted_name import dotted_name
from roslens.source.extract.interpreter.operations import chosen, computed, decided, opened
from roslens.source.extract.interpreter.vocabulary_streams import HELD, written_to
from roslens.source.extract.ir.program import (
    Call,
    Expression,
    Format,
    Item,
    Lambda,
    Literal,
    Mapping,
    Member,
    Name,
    Opaque,
    Operation,
    Sequence,
)
from roslens.source.extract.symbolic.condition import negated
from roslens.source.extract.symbolic.reason import NumberBelow
from roslens.source.extract.symbolic.text import Text, unknown
from roslens.source.extract.transfer.class_attributes import class_of_scope, read_first
from roslens.source.extract.transfer.closures import names_around
from roslens.source.extract.transfer.module_values import module_value
from roslens.source.extract.transfer.overload_choice import known_function
from roslens.source.extract.transfer.plugin_held import item_held

if TYPE_CHECKING:
    from roslens.source.extract.symbols.symbol_table import Defined
    from roslens.source.extract.transfer.context import Context


_PACKAGE_NAME = "ROS_PACKAGE_NAME"


class Expressions:
    """Values of expressions."""

    def __init__(self, ctx: Context) -> None:
        """Evaluate them in an evaluation of which the part for calls is there."""
        self.ctx = ctx
        self._state, self._budget = ctx.state, ctx.budget
        self._kinds: dict[type[Any], Function1[[Any], Value]] = {
            Literal: self.literal,
            Name: self.name,
            Member: self.member,
            Item: self.item,
            Call: ctx.calls.called,
            Operation: self.operation,
            Sequence: self.sequence,
            Mapping: self.mapping,
            Format: self.format,
            Lambda: self.closure,
            Opaque: self.opaque,
        }

    def value(self, expression: Expression) -> Value:
        """Return the value of an expression."""
        self._budget.spend()
        if type(expression) is Name and expression.name in (names := self._state.frame.names):
            return names[expression.name]
        return self._kinds[type(expression)](expression)

    def literal(self, expression: Literal) -> Value:
        """Return a literal."""
        value = expression.value
        match value:
            case str():
                return Text((value,)) if value else Text()
        return value

    def name(self, expression: Name) -> Value:
        """Return what a name means: a variable, a member, a constant, a function or class, or something outside."""
        ctx = self.ctx
        frame, name = ctx.state.frame, expression.name
        if name in frame.names:
            return frame.names[name]
        if name in frame.aliases:
            return self.value(frame.aliases[name][0])
        thing = frame.self
        if name == "self" or name == "this":
            return thing if thing is not None else Unknown("self")
        if frame.members is not None and name in frame.members:
            return frame.members[name]
        if ctx.state.globals:
            whole = ctx.index.global_name(name, frame.path, frame.scope)
            if whole in ctx.state.globals:
                return ctx.state.globals[whole]
        found = self.defined(name)
        if found is not None:
            return found
        return self.outside(ctx.index.meaning(frame.templates.get(name, name), frame.path, frame.scope))

    def outside(self, name: str) -> Value:
        """Return what a name means that is not of the workspace."""
        ctx = self.ctx
        if name == _PACKAGE_NAME:
            # catkin and rosconsole define it as the name of the project, which is that of the package.
            return Text.of(ctx.index.package(ctx.state.frame.path))
        if name == "cls":
            return class_of_scope(ctx)
        return ctx.given.words if name == "sys.argv" and ctx.given.words is not None else Named(name)

    def defined(self, name: str) -> Value:
        """Return what the workspace defines under a name; None where it does not."""
        ctx = self.ctx
        frame = ctx.state.frame
        of = frame.object.defined if frame.object is not None and "." not in name else None
        known, key = ctx.index.memo.defined, (0 if of is None else id(of.what), name, frame.path, frame.scope)
        found = known.get(key)
        if found is None:
            found = _defined(ctx, of, name)
            if found[0] not in ("function", "") or len(ctx.index.functions_of(name, frame.path, frame.scope)) < 2:
                # Which of several functions is meant depends on the program.
                known[key] = found
        kind, one, other = found
        if kind == "constant":
            return self._constant(one, other)
        if kind == "class":
            return Class(one)
        if kind == "method" or (kind == "function" and one.class_name):
            return Callable(one, other, frame.self)
        return Callable(one, other) if kind == "function" else None

    def _constant(self, name: str, found: tuple[str, Expression]) -> Value:
        ctx = self.ctx
        path, expression = found
        if (path, name) in ctx.state.constants:
            return ctx.state.constants[path, name]
        ctx.state.constants[path, name] = Unknown(f"the constant {name}")
        runs = ctx.index.programs[path].dialect.modules_run
        of_module = module_value(ctx, path, name.rpartition(".")[2], expression) if runs else None
        if of_module is not None:
            ctx.state.constants[path, name] = of_module[0]
            return of_module[0]
        of_class = runs and "." in name
        outer, ctx.state.frame = ctx.state.frame, Frame(path, name.rpartition(".")[0])
        try:
            value = self.value(expression)
        finally:
            ctx.state.frame = outer
        ctx.state.constants[path, name] = read_first(ctx, name, value) if of_class else value
        return ctx.state.constants[path, name]

    def member(self, expression: Member) -> Value:
        """Return a member of an object, or what a module of the workspace has."""
        of = self.value(expression.of)
        if type(of) is Named and self.ctx.dialect.classes_in_modules:
            found = self.defined(dotted_name(expression))
            if found is not None:
                return found
        return self.member_of(of, expression.name)

    def member_of(self, of: Value, name: str) -> Value:
        """Return a member of a value by name."""
        ctx = self.ctx
        match of:
            case Obj():
                return self._member_of_object(of, name)
            case Named():
                return self.outside(f"{of.name}.{name}")
            case Class():
                constant = ctx.index.member(of.defined, name)
                if constant is not None:
                    return self._constant(f"{of.defined.what.qualified_name}.{name}", constant)
                found = ctx.index.methods(of.defined, name)
                if found:
                    return Callable(found[0].what, found[0].path)
            case Text() if name in SAME:
                return of
            case Unknown():
                return of
        return Unknown(f"{name} of {_shown(of)}")

    def _member_of_object(self, of: Obj, name: str) -> Value:
        ctx = self.ctx
        if name in of.fields:
            return of.fields[name]
        if name == "__class__" and of.defined is not None:
            return Class(of.defined)
        method = ctx.named.method(of, name)
        if method is not None:
            if any(getattr(one, "name", "") == "property" for one in method.function.decorators):
                return ctx.call(Invocation(method))
            return method
        for one in ctx.index.chain(of.defined) if of.defined is not None else ():
            constant = ctx.index.member(one, name)
            if constant is not None:
                return self._constant(f"{one.what.qualified_name}.{name}", constant)
        return Unknown(f"{name} of a {of.type}")

    def item(self, expression: Item) -> Value:
        """Return an item."""
        ctx = self.ctx
        of = self.value(expression.of)
        match expression.key:
            case Opaque(text=text) if is_slice(text):
                return part_of(of, text)
        key = self.value(expression.key)
        match of, key:
            case dict(), _:
                return unguarded(of.get(hashable(key), Unknown(f"an item of {ctx.index.memo.text(expression.of)}")))
            case list(), int(place) if -len(of) <= place < len(of):
                return of[place] if has_place(of, place) else opened(self.ctx, expression)
            case Obj(), _:
                inside = item_held(of, key)
            case _:
                inside = item_of(of, key)
        match of:
            case _ if inside is not None:
                return inside
            case Text() if key == 0 and of.head:
                return Text.of(of.head[:1])
            case Unknown():
                return of
        return opened(self.ctx, expression)

    def operation(self, expression: Operation) -> Value:
        """Return the result of an operator."""
        ctx = self.ctx
        operator = expression.operator
        if operator in ("and", "or"):
            return decided(self.ctx, expression)
        if operator == "?:":
            return self._chosen(expression)
        if operator == "=":
            value = self.value(expression.operands[1])
            ctx.assign(expression.operands[0], value)
            return value
        values = [self.value(one) for one in expression.operands]
        match operator, values:
            case "<<", [Obj() as stream, *rest] if HELD in stream.fields:
                return written_to(stream, rest)
        if operator in ("+", "<<") and not (operator == "<<" and all(type(one) is int for one in values)):
            whole = values[0]
            for one in values[1:]:
                whole = self.sum(whole, one)
            return whole
        if operator == "not" and values:
            holds = ctx.truth(values[0])
            if holds is not None:
                return not holds
            test = test_of(values[0])
            return opened(self.ctx, expression, None if test is None else negated(test))
        return self.computed(operator, values, expression)

    def _chosen(self, expression: Operation) -> Value:
        decides = self.value(expression.operands[0])
        holds = self.ctx.truth(decides)
        if holds is not None:
            return self.value(expression.operands[1 if holds else 2])
        return self.either(expression, decides)

    def either(self, expression: Operation, decides: Value) -> Value:
        """Return one of two values, or what is known of both."""
        return chosen(self.ctx, expression, decides)

    def computed(self, operator: str, values: list[Value], expression: Operation) -> Value:
        """Return what an operator makes of values."""
        return computed(self.ctx, operator, values, expression)

    def sum(self, one: Value, other: Value) -> Value:
        """Return two values added: texts one after the other."""
        if type(one) is Text or type(other) is Text:
            return Text.of(as_text(one), as_text(other))
        match one, other:
            case list(), list():
                return [*one, *other]
            case int() | float(), int() | float():
                return one + other
            case Unknown(reason=reason), _ if type(reason) is not NumberBelow:
                return one
        return Unknown("a sum")

    def sequence(self, expression: Sequence) -> list[Value]:
        """Return a list."""
        return [self.value(one) for one in expression.items]

    def mapping(self, expression: Mapping) -> Table:
        """Return a dictionary."""
        found: Table = {}
        for key, value in expression.items:
            if type(key) is Opaque and key.text == "**":
                inner = self.value(value)
                match inner:
                    case dict():
                        found.update(inner)
                    case _:
                        found[unknown("an unknown key")] = inner
            else:
                found[hashable(self.value(key))] = self.value(value)
        return found

    def format(self, expression: Format) -> Text:
        """Return a text put together."""
        values = [self.value(one) for one in expression.parts]
        return Text.of(*(_TRUTHS[one] if type(one) is bool else as_text(one) for one in values))

    def closure(self, expression: Lambda) -> Value:
        """Return a function without name."""
        ctx = self.ctx
        frame = ctx.state.frame
        program = ctx.index.programs[frame.path]
        names = names_around(ctx, expression) if expression.holds or frame.aliases else frame.names
        return Callable(program.functions[expression.function], frame.path, frame.self, names)

    def opaque(self, expression: Opaque) -> Unknown:
        """Return that nothing is known."""
        return Unknown(expression.text or "an expression")

    def truth(self, value: Value) -> bool | None:
        """Return whether a value is true; None where that is unknown."""
        match value:
            case Text():
                return None if value.known is None else bool(value.known)
            case Unknown():
                return None
            case list() if value and all(type(one) is Guarded for one in value):
                return None
            case None | bool() | int() | float() | list() | dict():
                return bool(value)
            case Made():
                return True if value.certain else None
            case Callable() | Class():
                return True
        return None

    def ways_of(self, value: Value) -> list[Value]:  # noqa: ARG002 - a choice of two values is one of a kind
        """Return the values of which a value is one, as far as it is known to be one of several."""
        return []

    def items(self, value: Value) -> list[Value] | None:
        """Return what a loop goes through; None where it is unknown."""
        match value:
            case list():
                return value
            case dict():
                return list(value)
        return None


def _defined(ctx: Context, of: Defined | None, name: str) -> tuple[str, Any, Any]:
    """Return what the workspace defines under a name in an object of a class, or outside, and its kind."""
    frame, index = ctx.state.frame, ctx.index
    if of is not None:
        method = ctx.named.method_of(of, name)
        if method is not None:
            return "method", *method
        for one in index.chain(of):
            constant = index.member(one, name)
            if constant is not None:
                return "constant", f"{one.what.qualified_name}.{name}", constant
    outside = index.constant(name, frame.path, frame.scope)
    if outside is not None:
        path, value, whole = outside
        # What a constant of C++ is made of means what it does where that is defined.
        return "constant", name if index.programs[path].dialect.modules_run else whole, (path, value)
    found = index.class_of(name, frame.path, frame.scope)
    if found is not None:
        return "class", found, None
    functions = index.functions_of(name, frame.path, frame.scope)
    chosen = known_function(index, functions, (frame.path, ctx.emitter.first.path))
    if chosen is not None:
        return "function", chosen.what, chosen.path
    return "", None, None


def _shown(value: Value) -> str:
    return type(value).__name__.lower()


# Written once: a union that is written in a call is made in each call.
_TRUTHS = {True: Text(("True",)), False: Text(("False",))}
