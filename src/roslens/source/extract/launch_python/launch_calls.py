"""Calls in launch files in Python: what makes actions, what launch and the standard library mean, and what reads."""

from __future__ import annotations

from roslens.source.extract.domain.abstract_value import Names, Value
from roslens.source.extract.facts.node_facts import Evidence
from roslens.source.extract.interpreter.calls import Calls
from roslens.source.extract.ir.program import Call, Member, Name
from roslens.source.extract.launch_python.deferred import Deferred, resolve
from roslens.source.extract.launch_python.launch_file_reads import READS, Opened, read
from roslens.source.extract.launch_python.launch_values import Made, as_value, lifted, plain
from roslens.source.extract.launch_python.launch_ways import kept
from roslens.source.extract.launch_python.launch_words import ACTIONS, call_known, call_method, is_known
from roslens.source.extract.launch_python.visit import Visit
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
        return super().called(expression)

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
            place = Evidence(self.ctx.state.frame.path, expression.line, expression.column)
            return Made(last, place, list(arguments), given, tuple(dict.fromkeys(self.ctx.state.conditions)))
        if name not in READS and not is_known(name):
            return super().outer(name, expression, arguments, keywords, templates)
        positional = [plain(one) for one in arguments]
        if name in READS:
            return lifted(read(name, positional, self.ctx.state.frame.path, self.visit.files, self.visit.scope))
        return lifted(call_known(name, positional, {one: plain(value) for one, value in given.items()}))

    def plain_method(
        self, expression: Call, function: Member, of: Value, arguments: list[Value], keywords: Names
    ) -> Value:
        """Call a method of a text, a list or a table, of an object of launch, or of what is not known."""
        self.ctx.summaries.touch()
        name = function.name
        if name == "perform" and isinstance(of, Deferred | Text | Made):
            return lifted(self._resolved(as_value(of)))
        match of:
            case Made() if of.name == "LaunchDescription" and name.startswith("add_"):
                self.ctx.state.store.items(of.positional)
                of.positional.append([kept(self.ctx, one) for one in arguments])
                return None
            case list() if name in _ADDING:
                added = arguments[0] if name == "extend" and arguments and isinstance(arguments[0], list) else arguments
                arguments = [[kept(self.ctx, one) for one in added]]
                return super().plain_method(expression, Member(function.of, "extend"), of, arguments, keywords)
            case list() | dict() if name == "copy":
                return of.copy()
            case dict() if name in ("get", "pop") and len(arguments) == 1:
                arguments = [*arguments, None]
            case _ if isinstance(of, _TEXTS):
                given = {one: plain(value) for one, value in keywords.items()}
                written = self.ctx.index.memo.text(expression.function)
                return lifted(call_method(plain(of), name, [plain(one) for one in arguments], given, written))
        return super().plain_method(expression, function, of, arguments, keywords)

    def _resolved(self, value: Deferred | Text | str) -> Deferred | Text | str:
        return value if self.visit.scope is None else resolve(value, self.visit.scope)
