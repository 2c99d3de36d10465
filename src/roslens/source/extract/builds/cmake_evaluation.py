"""CMake files evaluated without running them: variables, conditions, loops, functions and macros, all bounded.

Where a condition is unknown, all its branches are evaluated, each with the condition kept, and what they set is merged.
The commands themselves are given: see the tables of :mod:`cmake_commands` and :mod:`cmake_targets`.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from posixpath import dirname

import msgspec

from roslens.intake.file_budget import file_budget
from roslens.source.extract.builds.cmake_condition import Word
from roslens.source.extract.builds.cmake_limits import Limits
from roslens.source.extract.builds.cmake_scope import Scope
from roslens.source.extract.builds.cmake_signals import WAYS_OUT, ExhaustedError, ReturnedError
from roslens.source.extract.builds.cmake_surroundings import folders_of
from roslens.source.extract.builds.cmake_syntax import (
    Argument,
    Block,
    Body,
    Command,
    Script,
    parse_cmake,
)
from roslens.source.extract.builds.cmake_value import hole, is_unknown, shown
from roslens.source.extract.builds.cmake_variables import Variables
from roslens.source.extract.facts.files import Files, joined
from roslens.source.extract.facts.launched import Unresolved
from roslens.source.extract.facts.node_facts import Evidence

SOURCE, BUILD = "/=workspace", "/=build"
"""Folders that stand for the root of the workspace and of its build."""

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
        self.limits = Limits()
        self.variables = Variables(self.limits)
        self.functions: dict[str, Defined] = {}
        self.conditions: list[str] = []
        self.unresolved: dict[Unresolved, None] = {}
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
        self._files: list[str] = []

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

    def seen(self, path: str, conditions: tuple[str, ...]) -> bool:
        """Note that a folder is added; return whether it was before, on the same side of what is unknown."""
        known = self.added.setdefault(path, conditions)
        nested = path in self._files
        return nested or (known is not conditions and known == conditions)

    # What conditions ask for

    def words(self, arguments: tuple[Argument, ...]) -> list[Word]:
        """Return the words of a condition."""
        return self.variables.words(arguments)

    def variable(self, name: str) -> tuple[str | None, bool]:
        """Return a variable's value, and whether the user may give it another."""
        return self.variables.variable(name)

    def matched(self, groups: Sequence[str]) -> None:
        """Set what a regular expression has matched, or that it has not."""
        self.variables.matched(groups)

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

    # Running

    def run_file(self, path: str, script: Script, *, shown_in: str = "") -> None:
        """Run a file in the current scope."""
        if self._files.count(path) >= MOST_SELF_INCLUDES:
            self.fail(path, Evidence(path, 1), f"a file includes itself more than {MOST_SELF_INCLUDES} times")
            return
        for fault in script.faults:
            self.fail(fault.what, Evidence(path, fault.line, fault.column), "not valid CMake")
        before = (
            self.path,
            self.variables.bound,
            self.variables.get("CMAKE_CURRENT_LIST_DIR"),
            self.variables.get("CMAKE_CURRENT_LIST_FILE"),
        )
        outer = len(self.conditions), self.left
        self.path, self.variables.bound = path, None
        self._files.append(path)
        self.variables.set("CMAKE_CURRENT_LIST_FILE", self.absolute(path))
        self.variables.set("CMAKE_CURRENT_LIST_DIR", shown_in or self.absolute(dirname(path)))
        try:
            with self.limits.deeper():
                self.run(script.body)
        except ReturnedError as signal:
            if signal.what == "stop":
                raise
        finally:
            self._files.pop()
            self.rejoin(outer)
            self.path, self.variables.bound = before[:2]
            self.variables.set("CMAKE_CURRENT_LIST_DIR", before[2])
            self.variables.set("CMAKE_CURRENT_LIST_FILE", before[3])

    def script(self, path: str) -> Script | None:
        """Return a file; None where there is none."""
        content = self.files.content(path)
        if content is None:
            return None
        with file_budget(path, size=len(content)):
            return parse_cmake(content)

    def run(self, body: Body) -> None:
        """Run commands and blocks in order."""
        for statement in body:
            self.limits.step()
            match statement:
                case Command():
                    self._run_command(statement)
                case _:
                    self._run_block(statement)

    def _run_block(self, block: Block) -> None:
        opened = block.branches[0][0]
        try:
            with self.limits.deeper():
                self._blocks[opened.name](self, block)
        except ExhaustedError as error:
            # Depth is given back by going up; steps and text are not.
            if self.limits.nested and not self.limits.spent:
                self.fail(f"{opened.name}()", self.evidence(opened), str(error))
                return
            raise

    def _run_command(self, command: Command) -> None:
        name = command.name
        handler = self._commands.get(name)
        if handler is not None:
            handler(self, Call(command, self.variables.expanded(command.arguments), self.evidence(command)))
        elif name in self.functions:
            self._run_function(command, self.functions[name])
        elif name in ("return", "break", "continue"):
            if command.arguments:
                self._propagate(self.variables.expanded(command.arguments))
            raise ReturnedError(name)
        elif name not in self._ignored:
            self._run_unknown(command)

    def _propagate(self, arguments: list[str]) -> None:
        """Give variables to where the function or folder that returns was called."""
        outer = self.variables.scope
        while outer.block and outer.parent is not None:
            outer = outer.parent
        if arguments[0] == "PROPAGATE" and outer.parent is not None:
            for name in arguments[1:]:
                value = self.variables.scope.get(name)[1]
                before = outer.parent.get(name)[1]
                unsure = len(self.variables.scope.layers) > 1 or len(outer.layers) > 1
                made = self.variables.either("".join(self.conditions[-1:]))(name, [value, before]) if unsure else value
                outer.parent.set(name, made)

    def run_within(self, command: Command, body: Body) -> None:
        """Run what a command makes: its place is that of the command."""
        self._calls.append((self.path, command))
        try:
            with self.limits.deeper():
                self.run(body)
        finally:
            self._calls.pop()

    def _run_unknown(self, command: Command) -> None:
        arguments = self.variables.expanded(command.arguments)
        self.variables.foreign.update(
            value for value in arguments if value.isidentifier() and not self.variables.scope.get(value)[0]
        )
        if arguments and arguments[0].isidentifier() and self.variables.scope.get(arguments[0])[1] is not None:
            # What it is given first it may set; further words are as often keywords of its own.
            self.variables.set(arguments[0], hole(f"{arguments[0]}, which {command.name}() may set"))
        self.fail(f"{command.name}()", self.evidence(command), "the command is not defined in the workspace")

    def _run_function(self, command: Command, function: Defined) -> None:
        values = self.variables.expanded(command.arguments)
        bound = {
            "ARGC": str(len(values)),
            "ARGV": ";".join(values),
            "ARGN": ";".join(values[len(function.parameters) :]),
        }
        bound.update((f"ARGV{number}", value) for number, value in enumerate(values[:100]))
        bound.update(zip(function.parameters, values, strict=False))
        self.limits.spend(sum(map(len, values)) * 2)
        before = self.variables.scope, self.variables.bound, self.path
        outer = len(self.conditions), self.left
        self._calls.append((self.path, command))
        if function.macro:
            self.variables.bound = bound
        else:
            self.variables.bound, self.variables.scope = None, Scope(self.variables.scope, dict(bound))
        self.path = function.path
        try:
            with self.limits.deeper():
                self.run(function.body)
        except ReturnedError as signal:
            if function.macro or signal.what == "stop":
                raise
        except ExhaustedError as error:
            # What calls itself for ever is left out from its outermost call on; what follows that call is not.
            if len(self._calls) > 1 or self.limits.spent:
                raise
            self.fail(f"{command.name}()", self.evidence(command), str(error))
        finally:
            self.variables.scope, self.variables.bound, self.path = before
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
        scope = self.variables.scope
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
