"""CMake files evaluated without running them: variables, conditions, loops, functions and macros, all bounded.

Where a condition is unknown, all its branches are evaluated, each with the condition kept, and what they set is merged.
The commands themselves are given: see the tables of :mod:`cmake_commands` and :mod:`cmake_targets`.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from posixpath import dirname

import msgspec

from roslens.source.extract.builds.cmake_condition import Word
from roslens.source.extract.builds.cmake_scope import Scope
from roslens.source.extract.builds.cmake_signals import WAYS_OUT, ExhaustedError, ReturnedError
from roslens.source.extract.builds.cmake_surroundings import NOT_ON_LINUX, folders_of, may_be_foreign
from roslens.source.extract.builds.cmake_syntax import (
    Argument,
    Block,
    Body,
    Command,
    Reference,
    Script,
    Template,
    parse_cmake,
    template_of,
)
from roslens.source.extract.builds.cmake_value import hole, is_unknown, items_of, reason_of, shown
from roslens.source.extract.facts.files import Files, joined
from roslens.source.extract.facts.launched import Unresolved
from roslens.source.extract.facts.node_facts import Evidence

SOURCE, BUILD = "/=workspace", "/=build"
"""Folders that stand for the root of the workspace and of its build."""

MOST_STEPS = 15_000
MOST_LENGTH = 100_000
MOST_TEXT = 10_000_000
MOST_ROUNDS = 1_000
MOST_DEPTH = 40
MOST_SELF_INCLUDES = 3


class Call(msgspec.Struct, frozen=True):
    """A command that is run, with the values of its arguments."""

    command: Command
    arguments: list[str]
    evidence: Evidence


class Defined(msgspec.Struct, frozen=True):
    """A function or macro."""

    name: str
    macro: bool
    parameters: tuple[str, ...]
    body: Body
    path: str


Handler = Callable[["Evaluation", Call], None]
BlockHandler = Callable[["Evaluation", Block], None]


class Evaluation:
    """The state of an evaluation of one package's CMake files."""

    def __init__(
        self,
        folder: str,
        files: Files,
        listing: Iterable[str],
        commands: Mapping[str, Handler],
        ignored: frozenset[str],
        blocks: Mapping[str, BlockHandler],
    ) -> None:
        """Prepare an evaluation.

        Args:
            folder: of the package, relative to the root of the workspace.
            files: that may be read.
            listing: the files of the package.
            commands: what commands do, by name in lower case.
            ignored: names of commands that are known to matter to nothing here.
            blocks: what blocks do, by the name of the command that opens them.
        """
        self.folder = joined("", folder)
        self.files = files
        self.listing = frozenset(listing)
        self.folders = folders_of(self.listing)
        self.scope = Scope()
        self.cache: dict[str, str] = {}
        self.environment: dict[str, str] = {}
        self.open: set[str] = set()
        self.foreign: set[str] = set()
        self.prefixes: set[str] = set()
        self.functions: dict[str, Defined] = {}
        self.conditions: list[str] = []
        self.unresolved: dict[Unresolved, None] = {}
        self.alternatives: dict[str, tuple[str, ...]] = {}
        self.targets: set[str] = set()
        self.where = self.folder
        self.added: dict[str, tuple[str, ...]] = {}
        self.path = ""
        self.loaded: set[str] = set()
        self.left = ""
        """By which of :data:`WAYS_OUT` what runs may have been left."""
        self.branch_left = ""
        """The same of the branch that was run last."""
        self._commands = commands
        self._ignored = ignored
        self._blocks = blocks
        self._calls: list[tuple[str, Command]] = []
        self._bound: dict[str, str] | None = None
        self._files: list[str] = []
        self._steps = self._text = self._depth = 0

    # Paths

    def relative(self, path: str, base: str | None = None) -> str | None:
        """Return a path below the root of the workspace; None where it is elsewhere or unknown."""
        if is_unknown(path):
            return None
        if path.startswith("/"):
            return joined("", path[len(SOURCE) :]) if path == SOURCE or path.startswith(f"{SOURCE}/") else None
        return joined(self.where if base is None else base, path)

    def absolute(self, path: str) -> str:
        """Return the absolute form of a path that is relative to the root of the workspace."""
        return f"{SOURCE}/{path}" if path else SOURCE

    # Telling

    def evidence(self, command: Command) -> Evidence:
        """Return where a command is, or the call that leads to it."""
        if self._calls:
            path, called = self._calls[0]
            return Evidence(path, called.line, called.column, f"by {called.name}()")
        return Evidence(self.path, command.line, command.column)

    def fail(self, text: str, evidence: Evidence, reason: str) -> None:
        """Note what could not be resolved."""
        self.unresolved.setdefault(Unresolved(shown(text)[:300], evidence, shown(reason)))

    # Variables

    def seen(self, path: str, conditions: tuple[str, ...]) -> bool:
        """Note that a folder is added; return whether it was before, on the same side of what is unknown."""
        known = self.added.setdefault(path, conditions)
        nested = path in self._files
        return nested or (known is not conditions and known == conditions)

    def get(self, name: str) -> str | None:
        """Return the value of a variable; None where it is not set. What others may have set is a hole."""
        known, value = self.scope.get(name)
        if value is not None:
            return value
        if name in self.cache:
            return self.cache[name]
        return hole(f"{name} of the build's surroundings") if self.is_foreign(name) and not known else None

    def kept(self, name: str) -> str | None:
        """Return the value that the files read have given to a variable; None where they have not set it."""
        value = self.scope.get(name)[1]
        return self.cache.get(name) if value is None else value

    def is_foreign(self, name: str) -> bool:
        """Return whether a variable may be set by what is not evaluated."""
        return may_be_foreign(name, self.foreign, self.prefixes)

    def set(self, name: str, value: str | None) -> None:
        """Set a variable of the current scope."""
        if value is not None and len(value) > MOST_LENGTH:
            value = hole(f"{name} is too long")
        self.scope.set(name, value)

    def spend(self, text: int) -> None:
        """Count characters that are made.

        Raises:
            ExhaustedError: they are too many.
        """
        self._text += text
        if self._text > MOST_TEXT:
            raise ExhaustedError(f"it makes more than {MOST_TEXT:,} characters")

    def value(self, template: Template) -> str:
        """Return the value of a template."""
        if len(template) == 1 and isinstance(template[0], Reference):
            return self._referenced(template[0])
        value = "".join(part if isinstance(part, str) else self._referenced(part) for part in template)
        self.spend(len(value))
        return value if len(value) <= MOST_LENGTH else hole("a text that is too long")

    def _referenced(self, reference: Reference) -> str:
        name = self.value(reference.name)
        if is_unknown(name):
            return hole(reason_of(name))
        if reference.of == "ENV":
            return self.environment.get(name, hole(f"environment {name}"))
        if reference.of == "CACHE":
            return self.cache.get(name, "")
        if self._bound is not None and reference.name == (name,) and name in self._bound:
            return self._replaced(self._bound[name])
        return self.get(name) or ""

    def _replaced(self, value: str) -> str:
        """Return the value of an argument of a macro: it is put into the text, and read as such."""
        if "$" not in value and "\\" not in value:
            return value
        bound, self._bound = self._bound, None
        found = self.value(template_of(value))
        self._bound = bound
        return found

    def expanded(self, arguments: Iterable[Argument]) -> list[str]:
        """Return the values of arguments; lists that are not quoted become several."""
        found: list[str] = []
        for argument in arguments:
            value = argument.literal if argument.literal is not None else self.value(argument.template)
            if argument.kind == "bare":
                if ";" in value:
                    self.spend(len(value))
                found.extend(items_of(value))
            else:
                found.append(value)
        if len(found) > MOST_LENGTH:
            raise ExhaustedError("a command has too many arguments")
        return found

    # What conditions ask for

    def words(self, arguments: tuple[Argument, ...]) -> list[Word]:
        """Return the words of a condition."""
        found: list[Word] = []
        for argument in arguments:
            if argument.kind == "paren":
                found.append(Word(argument.written, paren=True))
            elif argument.kind == "bare":
                found.extend(Word(value, paren=value in ("(", ")")) for value in self.expanded((argument,)))
            else:
                found.append(Word(self.expanded((argument,))[0], quoted=True))
        return found

    def variable(self, name: str) -> tuple[str | None, bool]:
        """Return a variable's value, and whether the user may give it another: those are in capitals."""
        if name.startswith("ENV{"):
            return self.environment.get(name[4:-1], hole(f"environment {name[4:-1]}")), False
        if name.startswith("CACHE{"):
            return self.cache.get(name[6:-1]), name[6:-1] in self.open or name[6:-1] not in self.cache
        known, value = self.scope.get(name)
        if value is not None:
            return value, False
        if name in self.cache:
            return self.cache[name], name in self.open
        if known:
            return None, False
        if self.is_foreign(name):
            return hole(name), True
        return None, name.isidentifier() and name.isupper() and name not in NOT_ON_LINUX

    def exists(self, path: str, *, folder: bool) -> bool | None:
        """Return whether there is a file or folder; None where that cannot be known."""
        found = self.relative(path)
        if found is None:
            return None
        if found in self.folders or (found in self.listing and not folder):
            return True
        inside = found == self.folder or found.startswith(f"{self.folder}/") or not self.folder
        return False if inside else None

    def target(self, name: str) -> bool | None:
        """Return whether there is a target: None of those of others."""
        return True if name in self.targets else None

    def command(self, name: str) -> bool | None:
        """Return whether there is a command: None of those that nobody here knows."""
        return True if name.lower() in self._commands or name.lower() in self.functions else None

    def matched(self, groups: Sequence[str]) -> None:
        """Set what a regular expression has matched, or that it has not."""
        filled = [number for number, group in enumerate(groups[:10]) if group]
        for number in range(10):
            if number in filled or self.scope.get(f"CMAKE_MATCH_{number}")[1] is not None:
                self.set(f"CMAKE_MATCH_{number}", groups[number] if number in filled else "")
        self.set("CMAKE_MATCH_COUNT", str(max(filled, default=0)))

    # Running

    def run_file(self, path: str, script: Script, *, shown_in: str = "") -> None:
        """Run a file in the current scope."""
        if self._files.count(path) >= MOST_SELF_INCLUDES:
            self.fail(path, Evidence(path, 1), f"a file includes itself more than {MOST_SELF_INCLUDES} times")
            return
        for fault in script.faults:
            self.fail(fault.what, Evidence(path, fault.line, fault.column), "not the language of CMake")
        before = self.path, self._bound, self.get("CMAKE_CURRENT_LIST_DIR"), self.get("CMAKE_CURRENT_LIST_FILE")
        outer = len(self.conditions), self.left
        self.path, self._bound = path, None
        self._files.append(path)
        self.set("CMAKE_CURRENT_LIST_FILE", self.absolute(path))
        self.set("CMAKE_CURRENT_LIST_DIR", shown_in or self.absolute(dirname(path)))
        try:
            with self.deeper():
                self.run(script.body)
        except ReturnedError as signal:
            if signal.what == "stop":
                raise
        finally:
            self._files.pop()
            self.rejoin(outer)
            self.path, self._bound = before[:2]
            self.set("CMAKE_CURRENT_LIST_DIR", before[2])
            self.set("CMAKE_CURRENT_LIST_FILE", before[3])

    def script(self, path: str) -> Script | None:
        """Return a file; None where there is none."""
        content = self.files.content(path)
        return None if content is None else parse_cmake(content)

    @contextmanager
    def deeper(self) -> Iterator[None]:
        """Count how deep blocks, calls and files are nested.

        Raises:
            ExhaustedError: they are nested too deep.
        """
        self._depth += 1
        try:
            if self._depth > MOST_DEPTH:
                raise ExhaustedError(f"blocks, calls and files are nested more than {MOST_DEPTH} deep")
            yield
        finally:
            self._depth -= 1

    def step(self) -> None:
        """Count a command or a round of a loop.

        Raises:
            ExhaustedError: they are too many.
        """
        self._steps += 1
        if self._steps > MOST_STEPS:
            raise ExhaustedError(f"it takes more than {MOST_STEPS:,} commands")

    def run(self, body: Body) -> None:
        """Run commands and blocks in order."""
        for statement in body:
            self.step()
            match statement:
                case Command():
                    self._run_command(statement)
                case _:
                    self._run_block(statement)

    def _run_block(self, block: Block) -> None:
        opened = block.branches[0][0]
        try:
            with self.deeper():
                self._blocks[opened.name](self, block)
        except ExhaustedError as error:
            # Depth is given back by going up; steps and text are not.
            if self._depth > 0 and self._steps <= MOST_STEPS and self._text <= MOST_TEXT:
                self.fail(f"{opened.name}()", self.evidence(opened), str(error))
                return
            raise

    def _run_command(self, command: Command) -> None:
        name = command.name
        handler = self._commands.get(name)
        if handler is not None:
            handler(self, Call(command, self.expanded(command.arguments), self.evidence(command)))
        elif name in self.functions:
            self._run_function(command, self.functions[name])
        elif name in ("return", "break", "continue"):
            if command.arguments:
                self._propagate(self.expanded(command.arguments))
            raise ReturnedError(name)
        elif name not in self._ignored:
            self._run_unknown(command)

    def _propagate(self, arguments: list[str]) -> None:
        """Give variables to where the function or folder that returns was called."""
        outer = self.scope
        while outer.block and outer.parent is not None:
            outer = outer.parent
        if arguments[0] == "PROPAGATE" and outer.parent is not None:
            for name in arguments[1:]:
                value = self.scope.get(name)[1]
                before = outer.parent.get(name)[1]
                unsure = len(self.scope.layers) > 1 or len(outer.layers) > 1
                made = self.either("".join(self.conditions[-1:]))(name, [value, before]) if unsure else value
                outer.parent.set(name, made)

    def run_within(self, command: Command, body: Body) -> None:
        """Run what a command makes: its place is that of the command."""
        self._calls.append((self.path, command))
        try:
            with self.deeper():
                self.run(body)
        finally:
            self._calls.pop()

    def _run_unknown(self, command: Command) -> None:
        arguments = self.expanded(command.arguments)
        self.foreign.update(value for value in arguments if value.isidentifier() and not self.scope.get(value)[0])
        if arguments and arguments[0].isidentifier() and self.scope.get(arguments[0])[1] is not None:
            # What it is given first it may set; further words are as often keywords of its own.
            self.set(arguments[0], hole(f"{arguments[0]}, which {command.name}() may set"))
        self.fail(f"{command.name}()", self.evidence(command), "the command is not defined in the workspace")

    def _run_function(self, command: Command, function: Defined) -> None:
        values = self.expanded(command.arguments)
        bound = {
            "ARGC": str(len(values)),
            "ARGV": ";".join(values),
            "ARGN": ";".join(values[len(function.parameters) :]),
        }
        bound.update((f"ARGV{number}", value) for number, value in enumerate(values[:100]))
        bound.update(zip(function.parameters, values, strict=False))
        self.spend(sum(map(len, values)) * 2)
        before = self.scope, self._bound, self.path
        outer = len(self.conditions), self.left
        self._calls.append((self.path, command))
        if function.macro:
            self._bound = bound
        else:
            self._bound, self.scope = None, Scope(self.scope, dict(bound))
        self.path = function.path
        try:
            with self.deeper():
                self.run(function.body)
        except ReturnedError as signal:
            if function.macro or signal.what == "stop":
                raise
        except ExhaustedError as error:
            # What calls itself for ever is left out from its outermost call on; what follows that call is not.
            if len(self._calls) > 1 or self._steps > MOST_STEPS or self._text > MOST_TEXT:
                raise
            self.fail(f"{command.name}()", self.evidence(command), str(error))
        finally:
            self.scope, self._bound, self.path = before
            self._calls.pop()
            if not function.macro:
                self.rejoin(outer)

    def leave(self, condition: str, way: str) -> None:
        """Note that what follows in this round, loop, function or file is run but where a condition does not hold."""
        denied = condition.removeprefix("NOT ")
        self.conditions.append(f"NOT ({condition})" if denied == condition or " " in denied else denied)
        self.left = max(way, self.left, key=WAYS_OUT.index)

    def rejoin(self, outer: tuple[int, str], way: str = "return") -> None:
        """Note that what may have been left in a way, or in a lesser one, ends here."""
        if WAYS_OUT.index(self.left) <= WAYS_OUT.index(way):
            del self.conditions[outer[0] :]
            self.left = outer[1]

    def perhaps(self, body: Body, conditions: list[str]) -> dict[str, str | None] | None:
        """Run what may not be run; return what it sets, None where configuration would fail there."""
        before, self.left = (len(self.conditions), self.left), ""
        self.conditions.extend(conditions)
        scope = self.scope
        scope.enter()
        failed, left = False, ""
        try:
            self.run(body)
        except ReturnedError as signal:
            failed = signal.what == "stop"
            left = "" if failed else signal.what
        finally:
            changes = scope.leave()
            del self.conditions[before[0] :]
            left, self.left = max(left, self.left, key=WAYS_OUT.index), before[1]
        self.branch_left = left
        return None if failed else changes

    def either(self, condition: str) -> Callable[[str, list[str | None]], str | None]:
        """Return what makes one value of those of branches of which the first has a condition."""

        def made(name: str, values: list[str | None]) -> str | None:
            lists = [items_of(value or "") for value in values]
            every = dict.fromkeys(item for items in lists for item in items)
            shared = [item for item in every if all(item in items for items in lists)]
            rest = tuple(item for item in every if item not in shared)[:100]
            unknown = hole(f"{name} depends on {condition}")
            self.alternatives[unknown] = rest
            return ";".join([*shared, unknown])

        return made
