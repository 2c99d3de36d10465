"""A Python launch file, evaluated from its syntax tree over the vocabulary of launch; nothing of it is executed.

Constants, lists, dictionaries, functions of the file, loops over what is known, and conditions are followed, within
bounds. Calls that are not known here are unknown values. Both ways of an unknown condition are followed, and what is
made there keeps the condition.
"""

from __future__ import annotations

import ast
from collections.abc import Callable
from typing import Any

from roslens.source.extract.facts.node_facts import Evidence
from roslens.source.extract.launch_python.deferred import Deferred, Scope, resolve
from roslens.source.extract.launch_python.launch_action import text
from roslens.source.extract.launch_python.launch_file_reads import READS, read
from roslens.source.extract.launch_python.launch_modules import ClassOfFile, Module, Modules, bring, bring_from, member
from roslens.source.extract.launch_python.python_arguments import bound, given, items_of
from roslens.source.extract.launch_python.python_calls import call_known, call_method, known_name
from roslens.source.extract.launch_python.python_control import MOST_TURNS, Left, Ways, branch, loop, repeat
from roslens.source.extract.launch_python.python_operation import combined, compared, put
from roslens.source.extract.launch_python.python_value import Bound, Closure, Dotted, Either, Made, Unknown, as_value
from roslens.source.extract.launch_python.python_weight import TooLongError, bounded
from roslens.source.extract.symbolic.text import Text

MOST_STEPS = 100_000
MOST_FRAMES = 25
_PATH = "#path"
"""Under this name what a file defines has its path."""


class Interpreter:
    """Evaluates one file.

    Attributes:
        path: of the file.
        scope: of the action that is visited, where a function is called by one; None while the file is read.
        missed: what could not be evaluated, with its place and reason.
    """

    def __init__(self, path: str, tree: ast.Module, modules: Modules | None = None) -> None:
        """Read the file: what stands outside of functions is evaluated."""
        self.path = path
        self.modules = modules or Modules()
        self.scope: Scope | None = None
        self.missed: list[tuple[Evidence, str, str]] = []
        self._steps = 0
        self._frames = 0
        self.notes: list[str] = []
        self.ways = Ways()
        self.defined: dict[str, Any] = {"__file__": Deferred("file"), "__name__": "launch", _PATH: path}
        self._names = [self.defined]
        self.block(tree.body)

    def function(self, name: str) -> Closure | None:
        """Return a function of the file."""
        found = self._names[0].get(name)
        return found if isinstance(found, Closure) else None

    @property
    def held(self) -> dict[str, Any]:
        """The innermost names."""
        return self._names[-1]

    def keep(self, name: str, value: Any) -> None:
        """Keep a value under a name."""
        self._names[-1][name] = value

    def call(self, function: Any, positional: list[Any], named: dict[str, Any], scope: Scope | None = None) -> Any:
        """Call a function of the file; what it returns may be unknown.

        Raises:
            TooLongError: the bounds are spent.
        """
        if not isinstance(function, Closure):
            return Unknown("it is no function of this file")
        before, self.scope = self.scope, scope or self.scope
        try:
            return self._closure(function, positional, named)
        finally:
            self.scope = before

    def place(self, node: ast.AST) -> Evidence:
        """Return where a node stands."""
        return Evidence(self.path, getattr(node, "lineno", 0), getattr(node, "col_offset", -1) + 1)

    def _closure(self, function: Closure, positional: list[Any], named: dict[str, Any]) -> Any:
        if self._frames >= MOST_FRAMES:
            return Unknown("functions that call each other too deeply")
        names = bounded(bound(function.node.args, positional, named, self.value))
        self._frames += 1
        outer, self._names = self._names, [*function.names, names]
        before, self.path = self.path, function.names[0].get(_PATH, self.path)
        ways, self.ways = self.ways, Ways(len(self.notes))
        try:
            if isinstance(function.node, ast.Lambda):
                return self.value(function.node.body)
            returned = self.block(function.node.body)
            return self.ways.result(returned.value if returned else None)
        finally:
            del self.notes[self.ways.start :]
            self._names, self.path, self.ways = outer, before, ways
            self._frames -= 1

    def block(self, body: list[ast.stmt]) -> Left | None:
        """Follow statements in order; return how they were left, None where they were not."""
        for statement in body:
            self._step()
            method = _STATEMENTS.get(type(statement))
            returned = method(self, statement) if method else None
            if returned is not None:
                return returned
        return None

    def _step(self) -> None:
        self._steps += 1
        if self._steps > MOST_STEPS:
            raise TooLongError

    def assign(self, statement: ast.Assign) -> None:
        """Assign a value to names, items and parts."""
        value = self.value(statement.value)
        for target in statement.targets:
            self.put(target, value)

    def assign_declared(self, statement: ast.AnnAssign) -> None:
        """Assign a value to a name with a type."""
        if statement.value is not None:
            self.put(statement.target, self.value(statement.value))

    def add_to(self, statement: ast.AugAssign) -> None:
        """Add to a name."""
        before = self.value(_loaded(statement.target))
        added = self.value(statement.value)
        if isinstance(before, list) and isinstance(added, list | tuple):
            before += bounded([self._keep(one) for one in added])
            return
        self.put(statement.target, combined(statement.op, before, added))

    def put(self, target: ast.expr, value: Any) -> None:
        """Put a value where an expression says."""
        match target:
            case ast.Name():
                self._names[-1][target.id] = bounded(value)
            case ast.Tuple() | ast.List():
                items = value if isinstance(value, list | tuple) and len(value) == len(target.elts) else None
                for index, one in enumerate(target.elts):
                    self.put(one, items[index] if items is not None else Unknown("a part of an unknown value"))
            case ast.Subscript():
                whole = self.value(target.value)
                put(whole, self.value(target.slice), bounded(value, whole))

    def evaluate(self, statement: ast.Expr) -> None:
        """Evaluate for what it changes."""
        self.value(statement.value)

    def returned(self, statement: ast.Return) -> Left:
        """Return a value."""
        return Left("return", self.value(statement.value) if statement.value else None)

    def attempt(self, statement: ast.Try) -> Left | None:
        """Take it that nothing is raised."""
        return self.block(statement.body) or self.block(statement.orelse) or self.block(statement.finalbody)

    def within(self, statement: ast.With | ast.AsyncWith) -> Left | None:
        """Evaluate a block with what it opens unknown."""
        for item in statement.items:
            value = self.value(item.context_expr)
            if item.optional_vars is not None:
                self.put(item.optional_vars, value)
        return self.block(statement.body)

    def define(self, statement: ast.FunctionDef | ast.AsyncFunctionDef) -> None:
        """Keep a function."""
        self._names[-1][statement.name] = Closure(statement, list(self._names))

    def define_class(self, statement: ast.ClassDef) -> None:
        """Keep a class with what is assigned in it, where no class from outside says what that means (``Enum``)."""
        bases = [self.value(one) for one in statement.bases]
        names: dict[str, Any] = {}
        for base in reversed(bases):
            names.update(base.names if isinstance(base, ClassOfFile) else {})
        self._names.append(names)
        for one in statement.body:
            if isinstance(one, ast.Assign | ast.AnnAssign):
                self.block([one])
        self._names.pop()
        known = not statement.keywords and all(isinstance(one, ClassOfFile) and one.plain for one in bases)
        found = ClassOfFile(statement.name, self.path, names if known else {}, known)
        self._names[-1][statement.name] = found

    def stop(self, statement: ast.stmt) -> Left:
        """End a block."""
        return Left(type(statement).__name__.lower())

    def value(self, node: ast.expr) -> Any:
        """Return the value of an expression."""
        self._step()
        method = _EXPRESSIONS.get(type(node))
        if method is None:
            return Unknown(f"{ast.unparse(node)[:60]!r}, which is not evaluated")
        return method(self, node)

    def constant(self, node: ast.Constant) -> Any:
        """Return a constant."""
        return node.value if isinstance(node.value, str | int | float | None) else Unknown("bytes")

    def name(self, node: ast.Name) -> Any:
        """Return what a name means here."""
        for names in reversed(self._names):
            if node.id in names:
                return names[node.id]
        return known_name(node.id)

    def attribute(self, node: ast.Attribute) -> Any:
        """Return an attribute."""
        of = self.value(node.value)
        match of:
            case Dotted():
                return Dotted(f"{of.name}.{node.attr}")
            case Unknown():
                return of
        return member(of, node.attr) if isinstance(of, Module | ClassOfFile) else Bound(of, node.attr)

    def sequence(self, node: ast.List | ast.Tuple | ast.Set) -> list[Any]:
        """Return a list; tuples and sets are lists too."""
        found: list[Any] = []
        for item in node.elts:
            match item:
                case ast.Starred():
                    items = items_of(self.value(item.value))
                    found += items if items is not None else [Unknown(f"each of {ast.unparse(item.value)}")]
                case _:
                    found.append(self.value(item))
        return found

    def dictionary(self, node: ast.Dict) -> dict[Any, Any]:
        """Return a dictionary; keys may be substitutions."""
        found: dict[Any, Any] = {}
        for key, value in zip(node.keys, node.values, strict=True):
            inner = self.value(value)
            if key is None:
                found.update(inner if isinstance(inner, dict) else {})
                continue
            name = self.value(key)
            match name:
                case str() | int() | float() | bool() | Deferred() | Text():
                    found[name] = inner
                case list():
                    found[text(*(as_value(one) for one in name))] = inner
        return found

    def binary(self, node: ast.BinOp) -> Any:
        """Return two values put together."""
        return combined(node.op, self.value(node.left), self.value(node.right))

    def unary(self, node: ast.UnaryOp) -> Any:
        """Return a value turned round."""
        value = self.value(node.operand)
        if isinstance(node.op, ast.Not):
            holds = self.truth(value)
            return Unknown(f"not {ast.unparse(node.operand)}") if holds is None else not holds
        return -value if isinstance(value, int | float) and isinstance(node.op, ast.USub) else value

    def boolean(self, node: ast.BoolOp) -> Any:
        """Return the value of ``and`` or ``or``."""
        stops = isinstance(node.op, ast.Or)
        value: Any = None
        for one in node.values:
            value = self.value(one)
            holds = self.truth(value)
            if holds is None:
                return Unknown(ast.unparse(node))
            if holds is stops:
                return value
        return value

    def compared(self, node: ast.Compare) -> Any:
        """Return whether a comparison holds."""
        values = [self._performed(self.value(one)) for one in (node.left, *node.comparators)]
        if any(isinstance(one, Unknown | Deferred | Text | Made | Either) for one in values):
            return Unknown(ast.unparse(node))
        holds = compared(node.ops, values)
        return Unknown(ast.unparse(node)) if holds is None else holds

    def chosen(self, node: ast.IfExp) -> Any:
        """Return one of two values."""
        holds = self.truth(self.value(node.test))
        if holds is None:
            return Either(ast.unparse(node.test), self.value(node.body), self.value(node.orelse))
        return self.value(node.body if holds else node.orelse)

    def joined(self, node: ast.JoinedStr) -> Any:
        """Return an f-string."""
        parts = []
        for part in node.values:
            match part:
                case ast.FormattedValue():
                    value = self._performed(self.value(part.value))
                    if part.format_spec is not None or part.conversion not in (-1, ord("s")):
                        value = Unknown(f"a format: {ast.unparse(part)[:60]}")
                    if isinstance(value, Deferred):
                        value = Unknown(f"a substitution in an f-string: {ast.unparse(part.value)}")
                    parts.append(as_value(value))
                case _:
                    parts.append(as_value(self.value(part)))
        return text(*parts) if parts else ""

    def item(self, node: ast.Subscript) -> Any:
        """Return an item of a list or dictionary."""
        of = self.value(node.value)
        if isinstance(of, Dotted) and of.name == "os.environ":
            return Deferred("environment", (as_value(self.value(node.slice)),))
        if isinstance(node.slice, ast.Slice) or not isinstance(of, list | dict | str):
            return of if isinstance(of, Unknown) else Unknown(ast.unparse(node))
        try:
            return of[self.value(node.slice)]
        except (LookupError, TypeError):
            return Unknown(ast.unparse(node))

    def comprehension(self, node: ast.ListComp | ast.GeneratorExp | ast.SetComp) -> Any:
        """Return what a comprehension makes, where what it goes through is known."""
        found: list[Any] = []
        self._names.append({})
        try:
            self._comprehend(node.generators, lambda: found.append(self.value(node.elt)))
        finally:
            self._names.pop()
        return found

    def comprehended(self, node: ast.DictComp) -> Any:
        """Return the dictionary that a comprehension makes."""
        found: dict[Any, Any] = {}

        def keep() -> None:
            key = self.value(node.key)
            if isinstance(key, str | int | Deferred | Text):
                found[key] = self.value(node.value)

        self._names.append({})
        try:
            self._comprehend(node.generators, keep)
        finally:
            self._names.pop()
        return found

    def _comprehend(self, generators: list[ast.comprehension], keep: Callable[[], None]) -> None:
        if not generators:
            keep()
            return
        first, *rest = generators
        items = items_of(self.value(first.iter))
        for item in items[:MOST_TURNS] if items is not None else [Unknown(f"each of {ast.unparse(first.iter)}")]:
            self.put(first.target, item)
            held = [self.truth(self.value(one)) for one in first.ifs]
            if False not in held:
                open_ = [ast.unparse(one) for one, known in zip(first.ifs, held, strict=True) if known is None]
                self.notes += open_
                self._comprehend(rest, keep)
                del self.notes[len(self.notes) - len(open_) :]

    def anonymous(self, node: ast.Lambda) -> Closure:
        """Return a function without name."""
        return Closure(node, list(self._names))

    def walrus(self, node: ast.NamedExpr) -> Any:
        """Assign within an expression."""
        value = self.value(node.value)
        self.put(node.target, value)
        return value

    def called(self, node: ast.Call) -> Any:
        """Return what a call makes."""
        function = self.value(node.func)
        positional, named = given(node, self.value)
        match function:
            case Closure():
                return self._closure(function, positional, named)
            case Bound():
                return self._method(function, positional, named, node)
            case Dotted() if function.name in READS:
                return read(function, positional, self.path, self.modules.files, self.scope)
            case Dotted():
                return call_known(function, positional, named, self.place(node), tuple(self.notes))
            case ClassOfFile():
                return function.unknown
        return function if isinstance(function, Unknown) else Unknown(f"call of {ast.unparse(node.func)[:60]}")

    def _method(self, bound: Bound, positional: list[Any], named: dict[str, Any], node: ast.Call) -> Any:
        if bound.name == "perform" and isinstance(bound.of, Deferred | Text | Made):
            return self._performed(as_value(bound.of))
        match bound.of:
            case list() if bound.name in ("append", "extend", "insert"):
                last = positional[-1] if positional else None
                found = last if bound.name == "extend" and isinstance(last, list) else [last]
                bound.of += bounded([self._keep(one) for one in found], bound.of)
                return None
            case Made() if bound.of.name == "LaunchDescription" and bound.name.startswith("add_"):
                bound.of.positional.append([self._keep(one) for one in positional])
                return None
        return call_method(bound, positional, named, ast.unparse(node.func)[:60])

    def _keep(self, value: Any) -> Any:
        """Return a value that is kept while a condition around it is unknown."""
        notes = tuple(self.notes)
        if notes and isinstance(value, Made) and value.notes != notes:
            return Made("_noted", value.evidence, [value], {}, notes)
        return value

    def _performed(self, value: Any) -> Any:
        """Return a substitution as what it comes to for the action that is visited, where that is known."""
        if not isinstance(value, Deferred | Text) or self.scope is None:
            return value
        found = resolve(value, self.scope)
        return found if found.known is None else found.known

    def truth(self, value: Any) -> bool | None:
        """Return whether a value is true; None where that is unknown."""
        value = self._performed(value)
        if isinstance(value, Unknown | Deferred | Text | Either):
            return None
        return True if isinstance(value, Made | Closure | Dotted | Bound) else bool(value)


def _loaded(target: ast.expr) -> ast.expr:
    return ast.copy_location(ast.parse(ast.unparse(target), mode="eval").body, target)


_STATEMENTS: dict[type[ast.stmt], Callable[[Interpreter, Any], Left | None]] = {
    ast.Assign: Interpreter.assign,
    ast.AnnAssign: Interpreter.assign_declared,
    ast.AugAssign: Interpreter.add_to,
    ast.Expr: Interpreter.evaluate,
    ast.Return: Interpreter.returned,
    ast.If: branch,
    ast.For: loop,
    ast.AsyncFor: loop,
    ast.While: repeat,
    ast.Try: Interpreter.attempt,
    ast.With: Interpreter.within,
    ast.AsyncWith: Interpreter.within,
    ast.FunctionDef: Interpreter.define,
    ast.AsyncFunctionDef: Interpreter.define,
    ast.ClassDef: Interpreter.define_class,
    ast.Import: bring,
    ast.ImportFrom: bring_from,
    ast.Break: Interpreter.stop,
    ast.Continue: Interpreter.stop,
    ast.Raise: Interpreter.stop,
}
_EXPRESSIONS: dict[type[ast.expr], Callable[[Interpreter, Any], Any]] = {
    ast.Constant: Interpreter.constant,
    ast.Name: Interpreter.name,
    ast.Attribute: Interpreter.attribute,
    ast.List: Interpreter.sequence,
    ast.Tuple: Interpreter.sequence,
    ast.Set: Interpreter.sequence,
    ast.Dict: Interpreter.dictionary,
    ast.BinOp: Interpreter.binary,
    ast.UnaryOp: Interpreter.unary,
    ast.BoolOp: Interpreter.boolean,
    ast.Compare: Interpreter.compared,
    ast.IfExp: Interpreter.chosen,
    ast.JoinedStr: Interpreter.joined,
    ast.Subscript: Interpreter.item,
    ast.ListComp: Interpreter.comprehension,
    ast.GeneratorExp: Interpreter.comprehension,
    ast.SetComp: Interpreter.comprehension,
    ast.DictComp: Interpreter.comprehended,
    ast.Lambda: Interpreter.anonymous,
    ast.NamedExpr: Interpreter.walrus,
    ast.Call: Interpreter.called,
}
