"""The CMake files of a package as rules see them: commands in order, each with the conditions around it.

Variables are followed as far as text goes: one that is set, in whatever arm, may be any of the values it is ever
given.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from functools import cached_property
from itertools import islice
from posixpath import dirname, join, normpath
from typing import TYPE_CHECKING

import msgspec

from roslens.intake.file_budget import file_budget
from roslens.source.rules.hit import Hit
from roslens.source.rules.views.package_files import PackageFiles

if TYPE_CHECKING:
    from roslens.source.extract.builds.cmake_syntax import Block, Body, Command

MOST_VALUES = 400
"""Of one argument or variable; a list that is longer is cut."""
_MOST_DEPTH = 6
_MOST_REFERENCES = 20
_LONGEST = 1_000
"""Characters of a value that is put into another one: lists that are doubled again and again would have no end."""
_MOST_REPLACED = 20_000_000
"""Characters that are made of all variables of a package; what is behind keeps its references, and is open."""
_REFERENCE = re.compile(r"\$\{([A-Za-z0-9_]+)\}")
_HERE = re.compile(r"\$\{CMAKE_CURRENT_SOURCE_DIR\}/?")
_LISTED = re.compile(r"\$\{CMAKE_CURRENT_LIST_DIR\}/?")
_TOP = re.compile(r"\$\{([A-Za-z0-9_]+)_SOURCE_DIR\}/?")
_OF_ANY_PROJECT = ("PROJECT", "CMAKE")
_TEST_SWITCH = re.compile(r"TEST", re.IGNORECASE)
_LOOPS = frozenset({"foreach", "while"})
_DEFINITIONS = frozenset({"function", "macro"})


class Written(msgspec.Struct, frozen=True):
    """A command where it stands.

    Attributes:
        command: as parsed.
        path: of its file, below the workspace.
        conditions: texts of the ``if`` around it, outermost first; of a later arm with ``NOT`` before it.
        inside: names of what else is around it: ``foreach``, ``while``, ``function``, ``macro``.
        words: the arguments, with the variables that are known replaced and lists taken apart.
        folder: of the sources that a relative path starts from: ``include()`` keeps that of the file that includes.
    """

    command: Command
    path: str
    conditions: tuple[str, ...] = ()
    inside: tuple[str, ...] = ()
    words: tuple[str, ...] = ()
    folder: str = ""

    @property
    def name(self) -> str:
        """Name of the command in lower case."""
        return self.command.name

    @property
    def text(self) -> str:
        """The command on one line, as written."""
        return f"{self.name}({' '.join(argument.written for argument in self.command.arguments)})"

    @property
    def defined(self) -> bool:
        """Whether it stands in a function or macro, and runs where that is called."""
        return any(one in _DEFINITIONS for one in self.inside)

    @property
    def for_tests(self) -> bool:
        """Whether an ``if`` around it asks for tests."""
        return any(_TEST_SWITCH.search(one) for one in self.conditions)

    def hit(self, rule: str, message: str, context: str = "") -> Hit:
        """Return a hit at the command."""
        at = self.command
        return Hit(rule, message, at.line, at.column, context=context or self.text[:200], path=self.path)


class CmakeView:
    """CMakeLists.txt of a package and what it adds and includes of the package's own files.

    Attributes:
        top: path of the first CMakeLists.txt below the workspace.
        commands: of all files, in the order in which they run; empty where there is none.
    """

    def __init__(self, package: PackageFiles) -> None:
        """Read the files that can be reached."""
        self._package = package
        self._values: dict[str, list[str]] = {"PROJECT_NAME": [], "CMAKE_PROJECT_NAME": []}
        self._read: set[str] = set()
        self._left = _MOST_REPLACED
        self.top = join(package.folder, "CMakeLists.txt")
        self.commands: tuple[Written, ...] = ()
        # Where setup.py builds a package, CMakeLists.txt was left behind by ROS 1 and nothing reads it.
        if self.top in package.by_path and (package.package.build_type != "ament_python" or 1 in package.ros):
            self.commands = tuple(self._file(self.top, package.folder, (), (), 0))

    @property
    def exists(self) -> bool:
        """Whether the package has a CMakeLists.txt at its top."""
        return bool(self._read)

    @cached_property
    def text(self) -> str:
        """All CMake files of the package, one after the other."""
        files = (one.path for one in self._package.files if one.language.value == "cmake")
        return "\n".join(self._package.read(path).decode("utf-8", "replace") for path in files)

    @cached_property
    def _named(self) -> frozenset[str]:
        return frozenset(re.findall(r"[\w-]+", re.sub(r"#[^\n]*", "", self.text)))

    def may_build(self, path: str) -> bool:
        """Return whether it may build a source: it names the file, or looks for files by a pattern."""
        stem = path.rpartition("/")[2].partition(".")[0]
        return bool({stem, "GLOB", "GLOB_RECURSE", "aux_source_directory"} & self._named) or not self.exists

    def named(self, *names: str) -> Iterator[Written]:
        """Yield the commands of these names (lower case), in order."""
        for one in self.commands:
            if one.name in names:
                yield one

    def first(self, *names: str) -> Written | None:
        """Return the first command of these names."""
        return next(self.named(*names), None)

    def project(self) -> str:
        """Return the name of the project; empty where that is unknown."""
        found = self._values["PROJECT_NAME"]
        return found[0] if len(set(found)) == 1 and "$" not in found[0] else ""

    def values(self, name: str) -> tuple[str, ...]:
        """Return what a variable may be made of."""
        return tuple(self._values.get(name, ()))

    def _file(
        self, path: str, folder: str, conditions: tuple[str, ...], inside: tuple[str, ...], depth: int
    ) -> Iterator[Written]:
        from roslens.source.extract.builds.cmake_syntax import parse_cmake

        if path in self._read or depth > _MOST_DEPTH:
            return
        self._read.add(path)
        content = self._package.read(path)
        with file_budget(path, size=len(content)):
            body = parse_cmake(content).body
        yield from self._body(body, (path, folder), conditions, inside, depth)

    def _body(
        self, body: Body, at: tuple[str, str], conditions: tuple[str, ...], inside: tuple[str, ...], depth: int
    ) -> Iterator[Written]:
        from roslens.source.extract.builds.cmake_syntax import Command

        for one in body:
            if isinstance(one, Command):
                written = self._write(one, at, conditions, inside)
                yield written
                if (further := self._further(written)) is not None:
                    folder = at[1] if written.name == "include" else dirname(further)
                    yield from self._file(further, folder, conditions, inside, depth + 1)
            else:
                yield from self._branches(one, at, conditions, inside, depth)

    def _branches(
        self, block: Block, at: tuple[str, str], conditions: tuple[str, ...], inside: tuple[str, ...], depth: int
    ) -> Iterator[Written]:
        earlier: list[str] = []
        for opening, part in block.branches:
            if opening.name in _LOOPS | _DEFINITIONS:
                yield self._write(opening, at, conditions, inside)
                yield from self._body(part, at, conditions, (*inside, opening.name), depth)
                continue
            around = (*conditions, *(f"NOT ({other})" for other in earlier))
            if opening.name in ("if", "elseif"):
                text = " ".join(argument.written for argument in opening.arguments)
                around = (*around, text)
                earlier.append(text)
            yield from self._body(part, at, around, inside, depth)

    def _write(
        self, command: Command, at: tuple[str, str], conditions: tuple[str, ...], inside: tuple[str, ...]
    ) -> Written:
        """Return a command as it is written, and remember what it sets."""
        written = Written(command, at[0], conditions, inside, self._words(command), at[1])
        self._remember(written)
        return written

    def _remember(self, written: Written) -> None:
        name, words = written.name, written.words
        if not words:
            return
        if name == "project":
            self._values["PROJECT_NAME"].append(words[0])
            self._values["CMAKE_PROJECT_NAME"].append(words[0])
        elif name == "set" and len(words) > 1:
            self._add(words[0], (one for one in words[1:] if one not in ("PARENT_SCOPE", "CACHE")))
        elif name == "list" and len(words) > 2 and words[0].upper() in ("APPEND", "PREPEND"):
            self._add(words[1], words[2:])
        elif name == "foreach" and len(words) > 1:
            self._add(words[0], (one for one in words[1:] if one not in ("IN", "LISTS", "ITEMS")))
            for listed in words[1:]:
                self._add(words[0], tuple(self._values.get(listed, ())))

    def _add(self, name: str, values: Iterable[str]) -> None:
        known = self._values.setdefault(name, [])
        itself = f"${{{name}}}"
        known.extend(one for one in dict.fromkeys(values) if one not in known and itself not in one)
        del known[MOST_VALUES:]

    def _words(self, command: Command) -> tuple[str, ...]:
        found: list[str] = []
        for argument in command.arguments:
            if argument.kind == "paren":
                continue
            if argument.literal is not None:
                found.extend(argument.literal.split(";") if argument.kind == "bare" else (argument.literal,))
            else:
                found.extend(self._replaced(argument.written.strip('"')))
        return tuple(found[:MOST_VALUES])

    def _replaced(self, text: str) -> list[str]:
        """Return what a text may be; values are kept replaced, so that each reference is looked at once."""
        if self._left <= 0:
            return [text]
        waiting = [""]
        at = 0
        for match in islice(_REFERENCE.finditer(text), _MOST_REFERENCES):
            known = (value for value in self._values.get(match[1], ()) if len(value) <= _LONGEST)
            values = tuple(known) or (match[0],)
            before = text[at : match.start()]
            made = (f"{one}{before}{value}" for one in waiting for value in values)
            waiting = list(islice(made, MOST_VALUES))
            at = match.end()
            self._left -= sum(map(len, waiting))
        return [one + text[at:] for one in waiting]

    def _further(self, written: Written) -> str | None:
        """Return the file of the package that a command runs."""
        if written.name not in ("add_subdirectory", "include") or not written.words or written.defined:
            return None
        path = self.inside(written.words[0], written)
        if path is None:
            return None
        path = join(path, "CMakeLists.txt") if written.name == "add_subdirectory" else path
        return path if path in self._package.by_path else None

    def inside(self, path: str, written: Written) -> str | None:
        """Return a path as a command writes it as one below the workspace; nothing where that is open."""
        if match := _HERE.match(path):
            whole = join(written.folder, path[match.end() :])
        elif match := _TOP.match(path):
            # The folder of another project is a download, or a part of a larger build.
            if match[1] not in (*_OF_ANY_PROJECT, self.project()):
                return None
            whole = join(self._package.folder, path[match.end() :])
        elif match := _LISTED.match(path):
            whole = join(dirname(written.path), path[match.end() :])
        else:
            whole = join(written.folder, path)
        return None if "$" in whole or whole.startswith("/") else normpath(whole)
