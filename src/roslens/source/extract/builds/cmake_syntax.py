"""CMake files as commands with arguments, and commands as blocks; each knows where it stands.

The grammar is that of cmake-language(7): bracket and quoted arguments, references that nest, escapes, bracket comments.
Generator expressions stay text. After a fault, reading goes on with the next line, so that a broken command costs
itself alone.
"""

from __future__ import annotations

import re
from bisect import bisect_right
from functools import lru_cache

import msgspec

MOST_FAULTS = 20
"""After so many the rest of a file is left out."""
MOST_NESTING = 60
"""Blocks and references nested deeper are left out."""


class Reference(msgspec.Struct, frozen=True, gc=False):
    """A reference to a variable: ``${name}``, ``$ENV{name}``, ``$CACHE{name}``; the name may have references too."""

    of: str
    name: tuple[str | Reference, ...]


Template = tuple[str | Reference, ...]
"""Text and references in order."""


class Argument(msgspec.Struct, frozen=True, gc=False):
    """An argument: as written and as a template; ``literal`` is its value where it has no reference.

    ``kind`` is ``bare``, ``quoted``, ``bracket`` or ``paren``.
    """

    written: str
    kind: str
    template: Template
    literal: str | None


class Command(msgspec.Struct, frozen=True, gc=False):
    """A command with its name in lower case; line and column count from 1."""

    name: str
    arguments: tuple[Argument, ...]
    line: int
    column: int


class Block(msgspec.Struct, frozen=True, gc=False):
    """What stands between a command and its end: ``branches`` are commands that open a part, and that part."""

    branches: tuple[tuple[Command, tuple[Command | Block, ...]], ...]


Body = tuple[Command | Block, ...]


class Fault(msgspec.Struct, frozen=True):
    """What is not of the language, and where."""

    line: int
    column: int
    what: str


class Script(msgspec.Struct, frozen=True):
    """A CMake file."""

    body: Body
    faults: tuple[Fault, ...] = ()


_SPACE = re.compile(r"(?:[ \t\r\n]+|#(?!\[=*\[)[^\n]*)+")
_NAME = re.compile(r"([A-Za-z_][A-Za-z0-9_]*)[ \t]*\(")
_BRACKET = re.compile(r"\[(=*)\[")
_BRACKET_COMMENT = re.compile(r"#\[(=*)\[")
_QUOTED = re.compile(r'"([^"\\]*(?:\\.[^"\\]*)*)"', re.DOTALL)
_BARE = re.compile(
    r'(?:[^\s()#"\\]|\\[^\n])(?:[^\s()#"\\$]+|\\[^\n]|\$\([^\s()"#\\]*\)|\$|"[^"\\\n]*(?:\\.[^"\\\n]*)*")*'
)
_ESCAPE = {"n": "\n", "t": "\t", "r": "\r", "\n": ""}
_PIECE = re.compile(r"[^$\\}]+|\$(?:ENV|CACHE)?\{|\$|\\.|\\|\}", re.DOTALL)
_OPENS = {"if": "endif", "foreach": "endforeach", "while": "endwhile", "function": "endfunction", "macro": "endmacro",
          "block": "endblock"}  # fmt: skip
_ENDS = frozenset(_OPENS.values())
_PARTS = frozenset({"elseif", "else"})


@lru_cache(maxsize=256)
def parse_cmake(content: bytes) -> Script:
    """Return the blocks and commands of a file; never raises."""
    reader = _Reader(content.decode("utf-8-sig", "replace"))
    commands = reader.commands()
    blocks = _Blocks(reader.faults)
    for command in commands:
        blocks.take(command)
    return Script(blocks.body(), tuple(reader.faults[:MOST_FAULTS]))


class _Reader:
    def __init__(self, text: str) -> None:
        self.text = text
        self.faults: list[Fault] = []
        self._at = 0
        self._starts = [0, *(match.end() for match in re.finditer("\n", text))]

    def commands(self) -> list[Command]:
        found: list[Command] = []
        while len(self.faults) < MOST_FAULTS:
            if not self._skip():
                continue
            if self._at >= len(self.text):
                break
            match = _NAME.match(self.text, self._at)
            if match is None:
                written = self.text[self._at : self._at + 30].split("\n", 1)[0]
                self._fault(self._at, f'"{written}" is not a command')
                continue
            start, self._at = self._at, match.end()
            arguments = self._arguments(start)
            if arguments is not None:
                line, column = self._place(start)
                found.append(Command(match[1].lower(), arguments, line, column))
        return found

    def _skip(self) -> bool:
        """Skip space and comments; False where a comment does not end."""
        while True:
            if space := _SPACE.match(self.text, self._at):
                self._at = space.end()
            bracket = _BRACKET_COMMENT.match(self.text, self._at)
            if bracket is None:
                return True
            end = self.text.find(f"]{bracket[1]}]", bracket.end())
            if end < 0:
                self._fault(self._at, "a bracket comment does not end")
                return False
            self._at = end + 2 + len(bracket[1])

    def _arguments(self, start: int) -> tuple[Argument, ...] | None:
        found: list[Argument] = []
        depth = 0
        while self._skip():
            if self._at >= len(self.text):
                self._fault(start, "a command does not end")
                return None
            sign = self.text[self._at]
            if sign == ")" and depth == 0:
                self._at += 1
                return tuple(found)
            if sign in "()":
                depth += 1 if sign == "(" else -1
                self._at += 1
                found.append(Argument(sign, "paren", (sign,), sign))
                continue
            argument = self._argument(sign)
            if argument is None:
                self._fault(self._at, "an argument does not end", start)
                return None
            found.append(argument)
        return None

    def _argument(self, sign: str) -> Argument | None:
        text = self.text
        if sign == "[" and (bracket := _BRACKET.match(text, self._at)):
            end = text.find(f"]{bracket[1]}]", bracket.end())
            if end < 0:
                return None
            first = bracket.end() + (1 if text[bracket.end()] == "\n" else 0)
            inside = text[first:end]
            written = text[self._at : end + 2 + len(bracket[1])]
            self._at += len(written)
            return Argument(written, "bracket", (inside,), inside)
        if sign == '"':
            quoted = _QUOTED.match(text, self._at)
            if quoted is None:
                return None
            self._at = quoted.end()
            return _templated(quoted[0], "quoted", quoted[1])
        bare = _BARE.match(text, self._at)
        if bare is None:
            return None
        self._at = bare.end()
        return _templated(bare[0], "bare", bare[0])

    def _place(self, offset: int) -> tuple[int, int]:
        line = bisect_right(self._starts, offset)
        return line, offset - self._starts[line - 1] + 1

    def _fault(self, offset: int, what: str, resume: int | None = None) -> None:
        self.faults.append(Fault(*self._place(offset), what))
        end = self.text.find("\n", offset if resume is None else max(resume, 0))
        self._at = len(self.text) if end < 0 else end + 1


def _templated(written: str, kind: str, inside: str) -> Argument:
    if "$" not in inside and "\\" not in inside:
        return Argument(written, kind, (inside,), inside)
    template = template_of(inside)
    literal = "".join(part for part in template if isinstance(part, str))
    return Argument(written, kind, template, literal if all(isinstance(part, str) for part in template) else None)


def template_of(text: str) -> Template:
    """Return the pieces of a text; a reference that does not end is text."""
    stack: list[tuple[str, list[str | Reference]]] = [("", [])]
    for match in _PIECE.finditer(text):
        piece = match[0]
        parts = stack[-1][1]
        if piece[-1] == "{" and piece[0] == "$" and len(stack) <= MOST_NESTING:
            stack.append((piece, []))
        elif piece == "}" and len(stack) > 1:
            opened, name = stack.pop()
            stack[-1][1].append(Reference(opened[1:-1], tuple(name)))
        elif piece[0] == "\\" and len(piece) == 2:
            parts.append(_escaped(piece[1]))
        else:
            parts.append(piece)
    while len(stack) > 1:
        opened, name = stack.pop()
        stack[-1][1].extend([opened, *name])
    return tuple(_merged(stack[0][1]))


def _escaped(sign: str) -> str:
    # An escaped semicolon stays escaped: it matters where the text becomes a list.
    return "\\;" if sign == ";" else _ESCAPE.get(sign, sign)


def _merged(parts: list[str | Reference]) -> list[str | Reference]:
    found: list[str | Reference] = []
    run: list[str] = []
    for part in parts:
        if isinstance(part, str):
            run.append(part)
            continue
        if run:
            found.append("".join(run))
            run = []
        found.append(part)
    if run:
        found.append("".join(run))
    return found


class _Open:
    """A block that has not ended."""

    def __init__(self, command: Command | None) -> None:
        self.branches: list[tuple[Command, tuple[Command | Block, ...]]] = []
        self.command = command
        self.body: list[Command | Block] = []

    def branch(self, command: Command | None) -> None:
        if self.command is not None:
            self.branches.append((self.command, tuple(self.body)))
        self.command = command
        self.body = []


class _Blocks:
    """Commands as blocks, as far as they have come."""

    def __init__(self, faults: list[Fault]) -> None:
        self._faults = faults
        self._stack = [_Open(None)]
        self._ends: list[str] = []
        self._too_deep = 0

    def take(self, command: Command) -> None:
        """Put a command where it belongs: it opens, parts or ends a block, or stands in one."""
        name = command.name
        if self._too_deep or (name in _OPENS and len(self._stack) > MOST_NESTING):
            self._leave_out(command)
        elif name in _OPENS:
            self._stack.append(_Open(command))
            self._ends.append(_OPENS[name])
        elif name in _PARTS and self._ends[-1:] == ["endif"]:
            self._stack[-1].branch(command)
        elif name in self._ends:
            while self._ends[-1] != name:
                self._miss_end()
            self._close()
        elif name in _ENDS or name in _PARTS:
            self._faults.append(Fault(command.line, command.column, f'"{name}" has no opening command'))
        else:
            self._stack[-1].body.append(command)

    def body(self) -> Body:
        """Return all of it, with the blocks ended that have no end."""
        while self._ends:
            self._miss_end()
        return tuple(self._stack[0].body)

    def _leave_out(self, command: Command) -> None:
        self._too_deep += (command.name in _OPENS) - (command.name in _ENDS)
        if command.name in _OPENS and self._too_deep == 1:
            what = f"more than {MOST_NESTING} blocks are nested"
            self._faults.append(Fault(command.line, command.column, what))

    def _miss_end(self) -> None:
        """End the innermost block, although its end is missing."""
        open_, end = self._stack[-1], self._ends[-1]
        first = open_.branches[0][0] if open_.branches else open_.command
        if first is not None:
            self._faults.append(Fault(first.line, first.column, f'"{first.name}" has no "{end}"'))
        self._close()

    def _close(self) -> None:
        ended = self._stack.pop()
        self._ends.pop()
        ended.branch(None)
        self._stack[-1].body.append(Block(tuple(ended.branches)))
