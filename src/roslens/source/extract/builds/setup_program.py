"""A setup.py as a program: what it gives to ``setup()``, by the interpreter that follows nodes; nothing is run.

The words of setuptools are those of this program only: another one may call a function of its own ``setup``.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from functools import partial
from posixpath import join

import msgspec

from roslens.source.extract.builds.cmake_files import matching
from roslens.source.extract.domain.abstract_value import Key, Names, NodeBuilder, Table, Unknown, Value
from roslens.source.extract.domain.frame import Frame
from roslens.source.extract.domain.guarded import Guarded
from roslens.source.extract.domain.kinds import known_text
from roslens.source.extract.domain.state import State
from roslens.source.extract.facts.files import joined
from roslens.source.extract.facts.node_facts import Evidence
from roslens.source.extract.interpreter.calls import Calls
from roslens.source.extract.interpreter.expressions import Expressions
from roslens.source.extract.interpreter.interpreter import Interpreter, Parts
from roslens.source.extract.interpreter.vocabulary_index import indexed
from roslens.source.extract.ir.program import Call, Expression, Mapping, Opaque, Sequence
from roslens.source.extract.lowering.python.located_program import Places, Written, located_program
from roslens.source.extract.symbolic.text import Text, unknown
from roslens.source.extract.transfer.budget import BudgetExceededError
from roslens.source.extract.transfer.context import Context
from roslens.source.extract.transfer.spread_lists import spread_out

_ODD = (ArithmeticError, AttributeError, LookupError, TypeError, ValueError, RecursionError)
_MOST_FILES = 2_000


class Given(msgspec.Struct, frozen=True):
    """What one call is given by name, and where it stands."""

    keywords: Names
    place: Written


class Found:
    """What a script gives to whom, and where values stand.

    Attributes:
        places: of expressions.
        folder: of the script, relative to the root of the workspace.
        listing: files of the package, relative likewise.
        setups: what each call of ``setup`` is given, in their order.
        modules: module and file of each call of ``generate_parameter_module``.
    """

    def __init__(self, places: Places, folder: str, listing: frozenset[str]) -> None:
        """Begin with nothing found."""
        self.places, self.folder, self.listing = places, folder, listing
        self.setups: list[Given] = []
        self.modules: list[tuple[Value, Value]] = []
        # By identity, as equal values may stand at several places.
        self._found: dict[int, tuple[Value | Key, Written]] = {}

    def add(self, value: Value | Key, place: Written) -> None:
        """Remember where a value stands."""
        self._found[id(value)] = (value, place)

    def place_of(self, value: Value | Key, otherwise: Written) -> Written:
        """Return where a value stands as far as that is known."""
        found = self._found.get(id(value))
        return found[1] if found is not None and found[0] is value else otherwise


class _Expressions(Expressions):
    """Expressions of a setup.py: where they stand is remembered."""

    def __init__(self, ctx: Context, found: Found) -> None:
        super().__init__(ctx)
        self._found = found

    def value(self, expression: Expression) -> Value:
        """Return the value of an expression, and remember where it stands."""
        value = super().value(expression)
        self._remember(value, expression)
        return value

    def sequence(self, expression: Sequence) -> list[Value]:
        """Return a list."""
        return spread_out(self.ctx, expression)

    def mapping(self, expression: Mapping) -> Table:
        """Return a dictionary; a key that is unknown keeps its place."""
        found: Table = {}
        for key, value in expression.items:
            if type(key) is Opaque and key.text == "**":
                inner = self.value(value)
                found.update(inner if isinstance(inner, dict) else {self._key(value, inner): inner})
            else:
                found[self._key(key, self.value(key))] = self.value(value)
        return found

    def _key(self, expression: Expression, value: Value) -> Key:
        if isinstance(value, Text | bool | int | float):
            return value
        key = unknown(value.reason if isinstance(value, Unknown) else "it is not a string")
        self._remember(key, expression)
        return key

    def _remember(self, value: Value | Key, expression: Expression) -> None:
        place = self._found.places.of(expression) if isinstance(value, _PLACED) else None
        if place is not None:
            self._found.add(value, place)


class _Calls(Calls):
    """Calls in a setup.py."""

    def __init__(self, ctx: Context, found: Found) -> None:
        super().__init__(ctx)
        self._script = found

    def outer(
        self, name: str, expression: Call, arguments: list[Value], keywords: Names, templates: tuple[str, ...]
    ) -> Value:
        """Return the result of calling something outside of the script."""
        last = name.rpartition(".")[2]
        if last == "join" and name not in _JOINS:
            last = ""
        word = _WORDS.get(last)
        if word is None:
            return super().outer(name, expression, arguments, keywords, templates)
        return word(self, expression, arguments, keywords)

    def setup(self, expression: Call, _arguments: list[Value], keywords: Names) -> Value:
        """A package says what it installs."""
        place = self._script.places.of(expression) or Written(expression.line, expression.column, "setup()")
        self._script.setups.append(Given(keywords, place))
        return None

    def parameters(self, _expression: Call, arguments: list[Value], keywords: Names) -> Value:
        """A module that declares parameters is made of a file: ``generate_parameter_module(name, file)``."""
        given = dict(enumerate(arguments))
        name, file = keywords.get("module_name", given.get(0)), keywords.get("yaml_file", given.get(1))
        self._script.modules.append((name, file))
        return None

    def table(self, _expression: Call, arguments: list[Value], keywords: Names) -> Value:
        """A table of what is given by name."""
        first = arguments[0] if arguments else {}
        if not isinstance(first, dict) or "**" in keywords:
            return Unknown("an unknown dictionary")
        return {**first, **{Text.of(name): value for name, value in keywords.items()}}

    def files(self, expression: Call, arguments: list[Value], _keywords: Names) -> Value:
        """The files of the package that fit a pattern."""
        pattern = known_text(arguments[0]) if arguments else None
        if pattern is None:
            return Unknown(f"the files of {self.ctx.index.memo.text(expression)}")
        prefix = f"{self._script.folder}/" if self._script.folder else ""
        wanted = joined(self._script.folder, pattern.replace("**/", ""))
        found = sorted(matching(wanted, self._script.listing, frozenset(), deep="**" in pattern))
        return [Text.of(path[len(prefix) :]) for path in found[:_MOST_FILES] if path.startswith(prefix)]

    def packages(self, _expression: Call, _arguments: list[Value], _keywords: Names) -> Value:
        """Packages of Python, of which nothing is asked."""
        return []

    def path(self, expression: Call, arguments: list[Value], _keywords: Names) -> Value:
        """Parts of a path joined."""
        parts = [known for one in arguments if (known := known_text(one)) is not None]
        if len(parts) < len(arguments) or not parts:
            return Unknown(self.ctx.index.memo.text(expression))
        return Text.of(join(*parts))


class SetupProgram:
    """An evaluation of a setup.py.

    Attributes:
        setups: what each call of ``setup`` is given, in their order.
        modules: module and file of each call of ``generate_parameter_module``.
        gave_up: why not all of it was followed, and from which line on; None where it was.
    """

    def __init__(self, content: bytes, path: str, listing: Iterable[str]) -> None:
        """Follow the script.

        Args:
            content: of the file.
            path: of it, relative to the root of the workspace.
            listing: files of the package, relative likewise.
        """
        program, places = located_program(content)
        self._found = found = Found(places, path.rpartition("/")[0], frozenset(listing))
        self.setups, self.modules = found.setups, found.modules
        names: Names = {"__name__": Text.of("__main__"), "__file__": Text.of("setup.py")}
        interpreter = Interpreter(
            indexed({path: program}),
            NodeBuilder("<module>", path, 1, "", parameters=[], endpoints=[], unresolved=[]),
            parts=Parts(partial(_Expressions, found=found), partial(_Calls, found=found)),
            state=State(Frame(path, "", names=names), Evidence(path, 1)),
        )
        self.gave_up: tuple[int, str] | None = program.incomplete[0] if program.incomplete else None
        try:
            interpreter.block(program.body)
        except BudgetExceededError:
            self.gave_up = (1, "it takes too many steps")
        except _ODD as error:
            self.gave_up = (1, f"it cannot be evaluated: {type(error).__name__}")

    def place_of(self, value: Value | Key, otherwise: Written) -> Written:
        """Return where a value stands as far as that is known."""
        return self._found.place_of(value, otherwise)


def items_of(value: Value) -> list[Value]:
    """Return the items of a list, whatever they depend on; of another value it alone."""
    items = value if isinstance(value, list) else [] if value is None else [value]
    return [one.value if isinstance(one, Guarded) else one for one in items]


_PLACED = (Text, Unknown, list, dict)
_JOINS = frozenset({"join", "os.path.join", "path.join", "posixpath.join"})
_Word = Callable[[_Calls, Call, list[Value], Names], Value]
_WORDS: dict[str, _Word] = {
    "setup": _Calls.setup,
    "generate_parameter_module": _Calls.parameters,
    "generate_distutils_setup": _Calls.table,
    "dict": _Calls.table,
    "glob": _Calls.files,
    "iglob": _Calls.files,
    "rglob": _Calls.files,
    "find_packages": _Calls.packages,
    "find_namespace_packages": _Calls.packages,
    "join": _Calls.path,
}
"""By the last name of what is called: scripts import setuptools, distutils and catkin_pkg in all forms."""
