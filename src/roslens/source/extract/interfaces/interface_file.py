"""Interface files (``.msg``, ``.srv``, ``.action``) of both generations of ROS, with the place of everything in them.

ROS 1 is read as genmsg reads it, ROS 2 as rosidl does; what they refuse becomes a failure, and the rest is kept.
The comment of a field is what stands above it without an empty line between, behind it, and below it where it is
indented; comments at the beginning of the file are those of the first part.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import PurePosixPath
from typing import TypeVar

from msgspec.structs import replace

from roslens.model.failure import Failure
from roslens.model.source import Location
from roslens.source.extract.interfaces.interface import Interface, InterfaceConstant, InterfaceField, Message, Value
from roslens.source.extract.interfaces.interface_types import (
    CONSTANT_TYPES,
    MisreadError,
    check_constant_name,
    check_field_name,
    field_type,
)
from roslens.source.extract.interfaces.interface_values import constant_value, default_value

_SEPARATOR = "---"
_PARTS = {"msg": 1, "srv": 2, "action": 3}
_Lines = list[tuple[int, str]]
_Declared = TypeVar("_Declared", InterfaceField, InterfaceConstant)


def read_interface(content: bytes, path: str, package: str, generation: int) -> tuple[Interface, tuple[Failure, ...]]:
    """Return the interface in a file, and what of it could not be understood.

    Args:
        content: of the file.
        path: of the file below the workspace root; its suffix decides what it is, its stem is the name.
        package: that it belongs to.
        generation: of ROS: 1 or 2.

    Raises:
        ValueError: the suffix is none of ``.msg``, ``.srv``, ``.action``.
    """
    file = PurePosixPath(path)
    kind = file.suffix[1:]
    if kind not in _PARTS:
        raise ValueError(f"{path}: expected .msg, .srv or .action")
    reader = _Reader(path, package, generation)
    parts = tuple(map(reader.message, reader.parts_of(reader.lines_of(content), kind)))
    failures = tuple(sorted(reader.failures, key=lambda failure: failure.location or Location(path)))
    return Interface(package, file.stem, kind, generation, parts, not failures), failures


class _Reader:
    def __init__(self, path: str, package: str, generation: int) -> None:
        self.failures: list[Failure] = []
        self._path = path
        self._package = package
        self._generation = generation
        self._decoded = True

    def lines_of(self, content: bytes) -> _Lines:
        text = content.decode("utf-8", "backslashreplace").replace("\r\n", "\n").replace("\r", "\n")
        if self._generation == 1:
            self._decoded = _is_utf_8(content)
            return list(enumerate(text.split("\n"), 1))
        if not _is_utf_8(content):
            self._fail(1, 1, "bytes that are not UTF-8", "a file in UTF-8")
        return list(enumerate(text.replace("\t", " ").splitlines(), 1))

    def parts_of(self, lines: _Lines, kind: str) -> Iterator[_Lines]:
        """Yield the lines of each part."""
        wanted = _PARTS[kind]
        if wanted == 1:
            yield lines
            return
        loose = self._generation == 1
        parts: list[_Lines] = [[]]
        for number, line in lines:
            if not (line.startswith(_SEPARATOR) if loose else line == _SEPARATOR):
                parts[-1].append((number, line))
            elif loose and kind == "srv" and len(parts) == wanted:
                continue
            else:
                parts.append([])
        if len(parts) != wanted and not (loose and kind == "srv"):
            found = f"{len(parts) - 1} lines {_SEPARATOR!r}"
            self._fail(len(lines) or 1, 1, found, f"{wanted - 1}, between the parts of a .{kind} file")
        yield from (parts + [[]] * wanted)[:wanted]

    def message(self, lines: _Lines) -> Message:
        """Return what one part declares."""
        head, rest = _comments_at_the_top(lines)
        fields: list[InterfaceField] = []
        constants: list[InterfaceConstant] = []
        comments: dict[int, list[str]] = {}
        above: list[str] = []
        last = 0
        for number, line in rest:
            code, mark, comment = line.partition("#")
            if not code.strip():
                if mark and code and last:
                    comments[last].append(_uncommented(comment))
                elif mark:
                    above.append(_uncommented(comment))
                else:
                    above = []
                continue
            comments[number] = [*above, _uncommented(comment)] if mark else above
            above, last = [], number
            match self._declared(line, code, number):
                case InterfaceConstant() as constant:
                    constants.append(constant)
                case InterfaceField() as field:
                    fields.append(field)
        self._check_names([*fields, *constants] if self._generation == 2 else fields)
        return Message(
            tuple(_commented(field, comments) for field in fields),
            tuple(_commented(constant, comments) for constant in constants),
            _joined([_uncommented(line.partition("#")[2]) for line in head]),
        )

    def _declared(self, line: str, code: str, number: int) -> InterfaceField | InterfaceConstant | None:
        """Return what a line declares; None, and a failure is kept, where it is not understood."""
        try:
            return self._declaration(line, code, number)
        except MisreadError as error:
            self._fail(number, _column(line, len(line) - len(line.lstrip())), error.found, error.expected)
            return None

    def _declaration(self, line: str, code: str, number: int) -> InterfaceField | InterfaceConstant:
        return self._ros1(line, code, number) if self._generation == 1 else self._ros2(code.rstrip(), number)

    def _ros1(self, line: str, code: str, number: int) -> InterfaceField | InterfaceConstant:
        words = [word for word in (piece.strip() for piece in code.strip().split(" ")) if word]
        if "=" not in code:
            if len(words) != 2:
                raise MisreadError(f"{code.strip()!r}", "a type and a name, separated by a space")
            check_field_name(words[1], 1)
            column = _column(line, code.rindex(words[1]))
            return InterfaceField(words[1], field_type(words[0], self._package, 1), None, "", number, column)
        if words[0] not in CONSTANT_TYPES[1]:
            raise MisreadError(f"constant of type {words[0]!r}", "a primitive type")
        if words[0] == "string":
            # genmsg takes what stands behind the first space for the name: an indented line gives another checksum.
            name, _, written = line[line.find(" ") + 1 :].partition("=")
            if not self._decoded and "\\x" in line:
                raise MisreadError("bytes that are not UTF-8 in a text", "a file in UTF-8")
        else:
            name, *values = (piece.strip() for piece in " ".join(words[1:]).split("="))
            if len(values) != 1:
                raise MisreadError(f"{code.strip()!r}", "one '='")
            written = values[0]
        name, written = name.strip(), written.strip()
        check_constant_name(name, 1)
        value = constant_value(words[0], written, 1)
        column = _column(line, line.rindex(name, 0, line.index("=")))
        return InterfaceConstant(name, words[0], value, written, "", number, column)

    def _ros2(self, code: str, number: int) -> InterfaceField | InterfaceConstant:
        type_, _, rest = code.partition(" ")
        rest = rest.lstrip()
        if not type_:
            raise MisreadError(f"{code!r}", "a type at the beginning of the line, as ROS 2 takes no indentation")
        if not rest:
            raise MisreadError(f"{code!r}", "a type and a name, separated by a space")
        column = _column(code, len(code) - len(rest))
        if "=" in rest:
            name, _, written = rest.partition("=")
            name, written = name.rstrip(), written.lstrip()
            if type_ not in CONSTANT_TYPES[2]:
                raise MisreadError(f"constant of type {type_!r}", "a primitive type")
            check_constant_name(name, 2)
            return InterfaceConstant(name, type_, constant_value(type_, written, 2), written, "", number, column)
        name, _, default = rest.partition(" ")
        of = field_type(type_, self._package, 2)
        check_field_name(name, 2)
        value: Value | None = default_value(of, default.lstrip()) if default.lstrip() else None
        return InterfaceField(name, of, value, "", number, column)

    def _check_names(self, declared: Sequence[InterfaceField | InterfaceConstant]) -> None:
        seen: set[str] = set()
        for one in declared:
            if one.name in seen:
                self._fail(one.line, one.column, f"name {one.name!r} again", "each name once")
            seen.add(one.name)

    def _fail(self, line: int, column: int, found: str, expected: str) -> None:
        place = Location(self._path, line, column)
        advice = f"Correct the line, or build the package with ROS {self._generation} to see its error"
        self.failures.append(
            Failure("interfaces", found, expected, advice, place, entity=f"file:{self._path}", partial=True)
        )


def _is_utf_8(content: bytes) -> bool:
    try:
        content.decode()
    except UnicodeDecodeError:
        return False
    return True


def _column(line: str, place: int) -> int:
    return len(line[:place].encode()) + 1


def _comments_at_the_top(lines: _Lines) -> tuple[list[str], _Lines]:
    for index, (_, line) in enumerate(lines):
        if not line.startswith("#"):
            return [line for _, line in lines[:index]], lines[index:]
    return [line for _, line in lines], []


def _uncommented(comment: str) -> str:
    return comment.lstrip("#").removeprefix(" ").rstrip()


def _joined(lines: list[str]) -> str:
    return "\n".join(lines).strip("\n")


def _commented(one: _Declared, comments: dict[int, list[str]]) -> _Declared:
    comment = _joined(comments[one.line])
    if not comment:
        return one
    return replace(one, comment=comment)
