"""Calls while source is evaluated: of functions of the workspace, of what ROS knows, and of what is in neither."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from roslens.source.extract.domain.abstract_value import (
    Callable,
    Class,
    Invocation,
    Named,
    Names,
    Obj,
    QosValue,
    Unknown,
    Value,
)
from roslens.source.extract.domain.owned_pointer import is_owner, owns_first
from roslens.source.extract.facts.node_facts import Evidence
from roslens.source.extract.interpreter.bound_functions import bound
from roslens.source.extract.interpreter.dotted_name import dotted_name
from roslens.source.extract.interpreter.language_calls import BINDS, FROM_THIS, KNOWN, of_language
from roslens.source.extract.interpreter.unknown_calls import may_set, method_of_plain
from roslens.source.extract.interpreter.vocabulary import CallSite, find_method, find_outer, guessed_method, is_method
from roslens.source.extract.ir.program import Call, Function, Member, Name
from roslens.source.extract.symbols.symbol_table import Defined, dotted, type_arguments, type_name
from roslens.source.extract.transfer.each_way import each_way
from roslens.source.extract.transfer.overload_choice import overload
from roslens.source.extract.transfer.refined_values import refine
from roslens.source.extract.transfer.spread_arguments import spread

if TYPE_CHECKING:
    from roslens.source.extract.transfer.context import Context

_SUPER = Name("super")
_WORD = re.compile(r"(?<![\w:])[A-Za-z_]\w*")
_OF_NO_OBJECT = (Name("staticmethod"), Name("classmethod"))


def _takes_object(function: Function) -> bool:
    """Return whether a function of a class of Python is called on an object of it."""
    return not any(one in _OF_NO_OBJECT for one in function.decorators)


class Calls:
    """Results of calls."""

    __slots__ = ("ctx",)

    def __init__(self, ctx: Context) -> None:
        """Call in an evaluation."""
        self.ctx = ctx

    def called(self, expression: Call) -> Value:
        """Return the result of a call."""
        ctx = self.ctx
        function = expression.function
        templates = tuple(map(self.template, expression.templates)) if expression.templates else ()
        match function:
            case Member():
                return self._method(expression, function, templates)
            case Name():
                name = function.name
            case _:
                name = ""
        known = name in KNOWN
        if known and name == "super" and not expression.arguments:
            return ctx.state.frame.self
        if (known and name in BINDS) or name.endswith((".bind", ".partial")):
            return bound([ctx.value(one) for one in expression.arguments])
        arguments, keywords = self._arguments(expression)
        ctx.state.at(expression)
        made = of_language(ctx, name, arguments, keywords, templates) if known else None
        if made is not None:
            return made[0]
        if name in ctx.state.frame.names or not name:
            return self.applied(ctx.value(function), expression, arguments, keywords, templates)
        return self._called_name(name, expression, arguments, keywords, templates)

    def _called_name(
        self, name: str, expression: Call, arguments: list[Value], keywords: Names, templates: tuple[str, ...]
    ) -> Value:
        ctx = self.ctx
        thing = ctx.state.frame.object
        if thing is None or "." in name:
            return self._called_elsewhere(name, expression, arguments, keywords, templates)
        method = ctx.named.methods(thing, name, len(arguments), arguments, templates)
        if method is not None:
            return ctx.call(Invocation(method, arguments, keywords, expression.arguments, templates))
        if name in thing.fields:
            return self.applied(thing.fields[name], expression, arguments, keywords, templates)
        if is_method(name):
            return self._called_inherited(thing, name, expression, arguments, keywords, templates)
        return self._called_elsewhere(name, expression, arguments, keywords, templates)

    def _called_inherited(
        self, thing: Obj, name: str, expression: Call, arguments: list[Value], keywords: Names,
        templates: tuple[str, ...],
    ) -> Value:  # fmt: skip
        """Call what has the name of a method of a library: that of a base, unless a function elsewhere is meant."""
        ctx = self.ctx
        called = self._call_of(expression, name, arguments, keywords, templates)
        known = find_method(ctx, thing, called)
        if known is not None:
            return known(ctx, thing, called)
        if not ctx.index.functions_of(*self._place(name)):
            guessed = self._guessed(thing, called)
            if guessed is not None:
                return guessed
        return self._called_elsewhere(name, expression, arguments, keywords, templates)

    def _called_elsewhere(
        self, name: str, expression: Call, arguments: list[Value], keywords: Names, templates: tuple[str, ...]
    ) -> Value:
        """Call a function or class outside of the class of the object, or something outside of the workspace."""
        ctx = self.ctx
        frame, memo = ctx.state.frame, ctx.index.memo
        of = None if frame.object is None else frame.object.defined
        key = (0 if of is None else id(of.what), name, frame.path, frame.scope, len(arguments) + len(keywords))
        meant = memo.outside.get(key)
        if meant is None:
            found = ctx.named.function(name, key[-1], arguments, templates) or ctx.expressions.defined(name)
            match found:
                case Callable() | Class():
                    return self._called_defined(found, name, expression, arguments, keywords, templates)
            place = (name, frame.path, frame.scope)
            meant = ctx.index.meaning(*place), ctx.index.alias(*place)
            if found is None and not ctx.index.functions_of(*place):
                memo.outside[key] = meant
        meaning, alias = meant
        if "<" in alias and not templates:
            defined, templates = self._of_template(name, alias)
            if defined is not None:
                return ctx.objects.construct(defined, arguments, keywords, templates)
        return self.outer(meaning, expression, arguments, keywords, templates)

    def _called_defined(
        self, found: Callable | Class, name: str, expression: Call, arguments: list[Value], keywords: Names,
        templates: tuple[str, ...],
    ) -> Value:  # fmt: skip
        """Call a function or class of the workspace that a name means; that of a type of pointers is a cast."""
        match found:
            case Callable() if "." in name:
                found = self._overload(found, name, arguments)
            case Class() if self.ctx.index.alias(*self._place(name)).endswith("*"):
                return arguments[0] if arguments else None
        return self.applied(found, expression, arguments, keywords, templates)

    def _of_template(self, name: str, alias: str) -> tuple[Defined | None, tuple[str, ...]]:
        """Return the class that a name is an alias of with template arguments, and these."""
        frame = self.ctx.state.frame
        plain, inside = type_name(alias)
        beside = f"{name.rpartition('.')[0]}.{plain}" if "." in name else plain
        found = (self.ctx.index.class_of(one, frame.path, frame.scope) for one in (beside, plain))
        templates = tuple(self.template(one) for one in type_arguments(inside))
        return next((one for one in found if one is not None), None), templates

    def _overload(self, found: Callable, name: str, arguments: list[Value]) -> Callable:
        """Return the function of a class that is called by its whole name: ``Base::init(connection)``."""
        ctx = self.ctx
        several = ctx.index.functions_of(name, ctx.state.frame.path, ctx.state.frame.scope)
        chosen = overload(ctx.index, several, len(arguments), arguments) if len(several) > 1 else None
        if chosen is None:
            return found
        return Callable(chosen.what, chosen.path, found.self, found.names, found.arguments)

    def outer(
        self, name: str, expression: Call, arguments: list[Value], keywords: Names, templates: tuple[str, ...]
    ) -> Value:
        """Return the result of calling something outside of the workspace."""
        ctx = self.ctx
        called = self._call_of(expression, name, arguments, keywords, templates)
        known = find_outer(ctx, name)
        if known is not None:
            return known(ctx, None, called)
        if is_owner(name) and owns_first(arguments):
            return arguments[0]
        for one in (*arguments, *keywords.values()):
            ctx.callbacks.give(one)
        may_set(ctx, expression, arguments, name)
        return Unknown(f"result of {name}()")

    def made_outer(self, name: str, arguments: list[Value], keywords: Names, templates: tuple[str, ...]) -> Value:
        """Return an object of a class outside of the workspace."""
        ctx = self.ctx
        called = CallSite(name, arguments, keywords, templates, (), ctx.state.site)
        known = find_outer(ctx, name)
        return known(ctx, None, called) if known is not None else Obj(name)

    def construct_outer(self, thing: Obj, name: str, arguments: list[Value], keywords: Names) -> None:
        """Construct a base of an object that is outside of the workspace."""
        ctx = self.ctx
        if (known := find_outer(ctx, name)) is not None:
            known(ctx, thing, CallSite(name, arguments, keywords, (), (), ctx.state.site))

    def _method(self, expression: Call, function: Member, templates: tuple[str, ...]) -> Value:
        ctx = self.ctx
        name, on = function.name, function.of
        of_super = type(on) is Call and on.function == _SUPER
        of = ctx.state.frame.self if of_super else ctx.value(on)
        arguments, keywords = self._arguments(expression)
        ctx.state.at(expression)
        if type(of) is Unknown and not is_method(name):
            return self.plain_method(expression, function, of, arguments, keywords)
        match of:
            case Named():
                return self._of_module(of, expression, function, arguments, keywords, templates)
            case Class():
                return self._of_class(of, expression, name, arguments, keywords)
            case Obj():
                if name in FROM_THIS:
                    return of
                if of_super:
                    return self._of_base(of, name, arguments, keywords)
                if of.ways:
                    return self._of_ways(of, expression, name, arguments, keywords, templates)
                method = ctx.named.methods(of, name, len(arguments) + len(keywords), arguments, templates)
                if method is not None:
                    return ctx.call(Invocation(method, arguments, keywords, expression.arguments, templates))
                if name in of.fields:
                    return self.applied(of.fields[name], expression, arguments, keywords, templates)
        return self._of_library(expression, function, of, arguments, keywords, templates)

    def _of_library(
        self, expression: Call, function: Member, of: Value, arguments: list[Value], keywords: Names,
        templates: tuple[str, ...],
    ) -> Value:  # fmt: skip
        """Call a method that the workspace does not have, of whatever value."""
        ctx = self.ctx
        called = self._call_of(expression, function.name, arguments, keywords, templates)
        known = find_method(ctx, of, called)
        match of:
            case QosValue() if known is not None:
                return refine(ctx, function.of, of, known(ctx, of, called))
            case _ if known is not None:
                return known(ctx, of, called)
            case Obj() if guessed := self._guessed(of, called):
                return guessed
        return self.plain_method(expression, function, of, arguments, keywords)

    def _of_ways(
        self, of: Obj, expression: Call, name: str, arguments: list[Value], keywords: Names,
        templates: tuple[str, ...],
    ) -> Value:  # fmt: skip
        """Call a method of each object that it may be."""
        ctx = self.ctx

        def call(thing: Obj) -> Value:
            method = ctx.named.methods(thing, name, len(arguments) + len(keywords), arguments, templates)
            if method is None:
                return Unknown(f"result of {name}()")
            return ctx.call(Invocation(method, arguments, keywords, expression.arguments, templates))

        return each_way(ctx, of, call)

    def plain_method(
        self, expression: Call, function: Member, of: Value, arguments: list[Value], keywords: Names
    ) -> Value:
        """Call a method of a text, a list or a table, or of what is not known."""
        return method_of_plain(self.ctx, expression, function, of, arguments, keywords)

    def _of_module(
        self, of: Named, expression: Call, function: Member, arguments: list[Value], keywords: Names,
        templates: tuple[str, ...],
    ) -> Value:  # fmt: skip
        """Call what a module of the workspace has (``import package.module``), or something outside of it."""
        ctx = self.ctx
        count = len(arguments) + len(keywords)
        inside = ctx.named.function(dotted_name(function), count) or self._class_of_module(function)
        if inside is not None:
            return self.applied(inside, expression, arguments, keywords, templates)
        beside: Class | None = None
        match function.of:
            case Member() as outer:
                beside = self._class_of_module(outer)
        if beside is not None:
            return self._of_class(beside, expression, function.name, arguments, keywords)
        templates = (*of.templates, *templates)
        if find_outer(ctx, f"{of.name}.{function.name}") is None:
            called = self._call_of(expression, function.name, arguments, keywords, templates)
            guessed = self._guessed(of, called)
            if guessed is not None:
                return guessed
        return self.outer(f"{of.name}.{function.name}", expression, arguments, keywords, templates)

    def _guessed(self, of: Value, called: CallSite) -> Value:
        """Return what a method makes that is known by its name alone; None where it is not."""
        ctx = self.ctx
        word = guessed_method(ctx, of, called)
        return None if word is None else word(ctx, Unknown("an object of a class outside of the workspace"), called)

    def _place(self, name: str) -> tuple[str, str, str]:
        ctx = self.ctx
        return name, ctx.state.frame.path, ctx.state.frame.scope

    def _class_of_module(self, function: Member) -> Class | None:
        ctx = self.ctx
        frame, name = ctx.state.frame, dotted_name(function)
        if not name or not ctx.dialect.classes_in_modules:
            return None
        found = ctx.index.class_of(name, frame.path, frame.scope)
        return None if found is None else Class(found)

    def _of_base(self, thing: Obj, name: str, arguments: list[Value], keywords: Names) -> Value:
        """Call a method of the next class after the one that is evaluated."""
        ctx = self.ctx
        if thing.defined is None:
            return Unknown(f"{name} of a base")
        chain = ctx.index.chain(thing.defined)
        here = ctx.state.frame.scope.rpartition(".")[0]
        places = [
            place
            for place, one in enumerate(chain)
            if one.what.qualified_name == here and one.path in (ctx.state.frame.path, chain[place].path)
        ]
        rest = chain[places[0] + 1 :] if places else chain[1:]
        if name == "__init__":
            if rest:
                ctx.objects.construct_as(thing, rest[0], arguments, keywords)
            else:
                ctx.objects.base_constructed(thing, chain[places[0] if places else 0], arguments, keywords)
            return None
        for one in rest:
            found = ctx.index.methods(one, name)
            if found:
                return ctx.call(Invocation(Callable(found[0].what, found[0].path, thing), arguments, keywords))
        called = CallSite(name, arguments, keywords, (), (), ctx.state.site)
        known = find_method(ctx, thing, called)
        return known(ctx, thing, called) if known is not None else Unknown(f"{name} of a base")

    def _of_class(self, of: Class, expression: Call, name: str, arguments: list[Value], keywords: Names) -> Value:
        """Call a function of a class: of a base with the object, or a static one."""
        ctx = self.ctx
        found = ctx.index.methods(of.defined, name)
        match name, arguments:
            case "__init__", [Obj() as thing, *rest]:
                ctx.objects.construct_as(thing, of.defined, rest, keywords)
                return None
        if found:
            what, path, given = found[0].what, found[0].path, expression.arguments
            bound_to: Value = None
            if arguments and _takes_object(what) and ctx.index.programs[path].dialect.methods_take_objects:
                # What the class is asked for gets the object as its first argument, which parameters leave out.
                bound_to, arguments, given = arguments[0], arguments[1:], given[1:]
            return ctx.call(Invocation(Callable(what, path, bound_to), arguments, keywords, given))
        return Unknown(f"result of {name}()")

    def applied(
        self, of: Value, expression: Call, arguments: list[Value], keywords: Names, templates: tuple[str, ...]
    ) -> Value:
        """Call a value."""
        ctx = self.ctx
        match of:
            case Callable():
                return ctx.call(Invocation(of, arguments, keywords, expression.arguments, templates))
            case Class():
                return ctx.objects.construct(of.defined, arguments, keywords, templates)
            case Named():
                return self.outer(of.name, expression, arguments, keywords, (*of.templates, *templates))
            case Unknown():
                return of
        return Unknown(f"result of {ctx.index.memo.text(expression.function)}()")

    def _arguments(self, expression: Call) -> tuple[list[Value], Names]:
        value = self.ctx.value
        if not expression.keywords:
            return [value(one) for one in expression.arguments], {}
        keywords = {name: value(one) for name, one in expression.keywords if name[0] != "*"}
        if len(keywords) < len(expression.keywords):
            return spread(self.ctx, expression)
        return [value(one) for one in expression.arguments], keywords

    def _call_of(
        self, expression: Call, name: str, arguments: list[Value], keywords: Names, templates: tuple[str, ...]
    ) -> CallSite:
        ctx = self.ctx
        place = Evidence(ctx.state.frame.path, expression.line, expression.column)
        return CallSite(name, arguments, keywords, templates, expression.arguments, place)

    def template(self, written: str) -> str:
        """Return a template argument with the template parameters around it replaced."""
        ctx = self.ctx
        bound = ctx.state.frame.templates
        if bound:
            written = _WORD.sub(lambda found: bound.get(found[0], found[0]), written)
        whole = ctx.index.alias(dotted(written), ctx.state.frame.path, ctx.state.frame.scope)
        if "<" in whole and "<" not in written:
            return whole
        meaning = ctx.index.meaning(dotted(written), ctx.state.frame.path, ctx.state.frame.scope)
        return meaning.replace(".", "::") if "<" not in written and meaning != dotted(written) else written
