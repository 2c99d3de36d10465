"""Calls in launch files in Python: what makes actions, what launch and the standard library mean, and what reads."""

from __future__ import annotations

import msgspec

from roslens.source.extract.domain.abstract_value import Callable, Invocation, Names, Obj, Value
from roslens.source.extract.facts.node_facts import Evidence
from roslens.source.extract.interpreter.calls import Calls
from roslens.source.extract.ir.program import Call, Expression, Member, Name
from roslens.source.extract.launch_python.copied_in_launch import COPIES, copied_in_launch
from roslens.source.extract.launch_python.deferred import Deferred, resolve
from roslens.source.extract.launch_python.file_changes import stands_for
from roslens.source.extract.launch_python.launch_file_reads import PATH_READS, READS, read
from roslens.source.extract.launch_python.launch_functions import (
    FUNCTIONS,
    Bound,
    Calling,
    Partial,
    Shape,
    call_with_functions,
)
from roslens.source.extract.launch_python.launch_values import (
    PARAMETER_FILES,
    Either,
    Made,
    Opened,
    as_value,
    lifted,
    plain,
)
from roslens.source.extract.launch_python.launch_ways import either, kept
from roslens.source.extract.launch_python.launch_words import ACTIONS, call_known, call_method, is_at_once, is_known
from roslens.source.extract.launch_python.moveit_launches import (
    is_configs,
    is_of_moveit,
    made_by_moveit,
    method_of_configs,
)
from roslens.source.extract.launch_python.visit import Visit
from roslens.source.extract.symbolic.condition import negated
from roslens.source.extract.symbolic.text import Text
from roslens.source.extract.transfer.context import Context

_TEXTS = (Text, Deferred, Opened)
_ADDING = frozenset({"append", "extend"})
_STR = Name("str")


class LaunchCalls(Calls):
    """Results of calls in a launch file."""

    def __init__(self, ctx: Context, visit: Visit) -> None:
        """Call while an action is visited, or the file is read."""
        super().__init__(ctx)
        self.visit = visit

    def called(self, expression: Call) -> Value:
        """Return the result of a call."""
        if expression.function == _STR and len(expression.arguments) == 1 and "str" not in self.ctx.state.frame.names:
            return lifted(as_value(self.ctx.value(expression.arguments[0])))
        held = self._held(expression.function)
        if held is not None:
            arguments, keywords = self._arguments(expression)
            return self.applied(held, expression, arguments, keywords, ())
        return super().called(expression)

    def _held(self, function: Expression) -> Value:
        """Return what a name of the file stands for, where calling that has a meaning of its own."""
        match function:
            case Name(name=name) if name not in self.ctx.state.frame.names:
                found = self.ctx.expressions.defined(name)
            case _:
                return None
        match found:
            case Partial() | Shape() | Bound():
                return found
        return None

    def outer(
        self, name: str, expression: Call, arguments: list[Value], keywords: Names, templates: tuple[str, ...]
    ) -> Value:
        """Return the result of calling something outside of the workspace."""
        self.ctx.summaries.touch()
        last = name.rpartition(".")[2]
        given = {one: value for one, value in keywords.items() if one != "**"}
        if last in ACTIONS:
            first = arguments[0] if arguments else None
            if last == "LaunchDescription" and isinstance(first, list):
                arguments = [list(first), *arguments[1:]]
            return self._made(last, expression, arguments, given)
        if name in COPIES and arguments:
            return copied_in_launch(self.ctx, arguments[0], deep=name == "copy.deepcopy")
        if name in FUNCTIONS:
            return call_with_functions(name, self._calling(expression, arguments, keywords))
        if is_of_moveit(name):

            def make(kind: str, positional: list[Value], named: Names) -> Made:
                return self._made(kind, expression, positional, named)

            return made_by_moveit(name, arguments, given, make, self.visit.files)
        if name not in READS and not is_known(name):
            return super().outer(name, expression, arguments, keywords, templates)
        positional = [plain(one) for one in arguments]
        if name in READS:
            return lifted(read(name, positional, self.ctx.state.frame.path, self.visit.files, self.visit.scope))
        found = lifted(call_known(name, positional, {one: plain(value) for one, value in given.items()}))
        return self.visit.at_once(found) if is_at_once(name) else found

    def _made(self, name: str, expression: Call, arguments: list[Value], given: Names) -> Made:
        """Return an object of a class of launch."""
        place = Evidence(self.ctx.state.frame.path, expression.line, expression.column)
        made = Made(name, place, list(arguments), given, tuple(dict.fromkeys(self.ctx.state.conditions)))
        return msgspec.structs.replace(made, stands_for=stands_for(made)) if name in PARAMETER_FILES else made

    def _calling(self, expression: Call, arguments: list[Value], keywords: Names) -> Calling:
        def apply(of: Value, given: list[Value], named: Names) -> Value:
            return self.applied(of, expression, given, named, ())

        return Calling(self.ctx, self.ctx.index.memo.text(expression), apply, arguments, keywords)

    def applied(
        self, of: Value, expression: Call, arguments: list[Value], keywords: Names, templates: tuple[str, ...]
    ) -> Value:
        """Call a value: a function or class of the workspace or of a library, or one of which arguments are given."""
        match of:
            case Partial():
                inside = (expression, [*of.arguments, *arguments], {**of.keywords, **keywords}, templates)
                return self.applied(of.function, *inside)
            case Shape():
                return of.make(arguments, keywords)
            case Bound():
                function = Member(Name(""), of.name)
                return self.plain_method(expression, function, of.of, arguments, keywords)
            case Callable():
                # What is called by a function of a library has other arguments than that.
                return self.ctx.call(Invocation(of, arguments, keywords))
        return super().applied(of, expression, arguments, keywords, templates)

    def plain_method(
        self, expression: Call, function: Member, of: Value, arguments: list[Value], keywords: Names
    ) -> Value:
        """Call a method of a text, a list or a table, of an object of launch, or of what is not known."""
        self.ctx.summaries.touch()
        name = function.name
        if name == "perform" and isinstance(of, Deferred | Text | Made):
            return lifted(self._performed(as_value(of), expression))
        match of:
            case Made() if of.name == "LaunchDescription" and name.startswith("add_"):
                self.ctx.state.store.items(of.positional)
                of.positional.append([kept(self.ctx, one) for one in arguments])
                return None
            case list() if name in _ADDING:
                added = arguments[0] if name == "extend" and arguments and isinstance(arguments[0], list) else arguments
                arguments = [[kept(self.ctx, one) for one in added]]
                return super().plain_method(expression, Member(function.of, "extend"), of, arguments, keywords)
            case Obj() if is_configs(of):
                return method_of_configs(of, name)
            case Obj() if name == "perform_substitution" and arguments:
                return lifted(self._performed(as_value(plain(arguments[0])), expression))
            case Deferred() if name == "find" and of.kind in ("share", "prefix") and arguments:
                return self.visit.at_once(Deferred(of.kind, (as_value(plain(arguments[0])),)))
            case Text() | Deferred() if name in PATH_READS:
                return lifted(self._read_path(name, as_value(plain(of)), arguments))
            case Either():
                return self._method_of_either(expression, function, of, arguments, keywords)
            case dict() if name in ("get", "pop") and len(arguments) == 1:
                arguments = [*arguments, None]
            case _ if isinstance(of, _TEXTS):
                given = {one: plain(value) for one, value in keywords.items()}
                written = self.ctx.index.memo.text(expression.function)
                return lifted(call_method(plain(of), name, [plain(one) for one in arguments], given, written))
        return super().plain_method(expression, function, of, arguments, keywords)

    def _method_of_either(
        self, expression: Call, function: Member, of: Either, arguments: list[Value], keywords: Names
    ) -> Value:
        """Call a method of one of two values: what it changes is changed if that is the one."""
        found: list[Value] = []
        for condition, one in ((of.condition, of.one), (negated(of.condition), of.other)):
            here = len(self.ctx.state.conditions)
            self.ctx.state.under(condition)
            found.append(self.plain_method(expression, function, one, arguments, keywords))
            del self.ctx.state.conditions[here:]
        return either(found[0], found[1], of.condition)

    def _read_path(self, name: str, path: Deferred | Text | str, arguments: list[Value]) -> object:
        positional = [path, *(plain(one) for one in arguments)]
        return read(PATH_READS[name], positional, self.ctx.state.frame.path, self.visit.files, self.visit.scope)

    def _performed(self, value: Deferred | Text | str, expression: Call) -> Deferred | Text | str:
        state, scope = self.ctx.state, self.visit.scope
        if scope is None:
            return value
        if self.visit.reporting is not None and not state.conditions:
            place = Evidence(state.frame.path, expression.line, expression.column)
            scope = msgspec.structs.replace(self.visit.reporting, at=place)
        return resolve(value, scope)
