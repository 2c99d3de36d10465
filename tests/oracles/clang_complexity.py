"""Count the decisions of C++ functions over Clang's syntax tree: the table that ours is held against.

Decisions are counted as written: a node counts when its own token stands in the text of the file, not when
it comes out of a macro; what a macro repeats counts once. Clang sees only the arms of ``#if`` that are
compiled in.

    python tests/oracles/clang_complexity.py --include DIR [--include DIR …] SOURCES > table.tsv

needs the package ``libclang`` (18.1.1 was used), the ROS 1 headers of Debian (``ros-base-dev`` and what
the sources include) and GCC's builtin headers. Columns: path below SOURCES, line, name, complexity. Only
functions of at least three and only files that Clang compiles without an error are in the table.
"""

from __future__ import annotations

import argparse
import ctypes
import re
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

SUFFIXES = (".c", ".cc", ".cpp", ".cxx", ".h", ".hpp")
SMALLEST = 3
LOGICAL_AND, LOGICAL_OR = 20, 21
"""Of libclang's CXBinaryOperatorKind."""


def main() -> int:
    arguments = argparse.ArgumentParser(description=__doc__)
    arguments.add_argument("sources", type=Path)
    arguments.add_argument("--include", action="append", default=[])
    arguments.add_argument("--quote", action="append", default=[], help='folders for #include "…" only')
    arguments.add_argument("--skip", default="", help="regular expression of paths to leave out")
    options = arguments.parse_args()
    compiled = 0
    files = [
        path
        for path in sorted(options.sources.rglob("*"))
        if path.suffix in SUFFIXES and not (options.skip and re.search(options.skip, str(path)))
    ]
    for path in files:
        rows = table_of(path, options.include, options.quote)
        if rows is None:
            continue
        compiled += 1
        for line, name, complexity in rows:
            if complexity >= SMALLEST:
                print(path.relative_to(options.sources), line, name, complexity, sep="\t", flush=True)
    print(f"{compiled} of {len(files)} files compile", file=sys.stderr)
    return 0


def table_of(path: Path, includes: list[str], quotes: list[str]) -> list[tuple[int, str, int]] | None:
    """Return line, name and complexity of each function in the file; None where Clang finds an error."""
    from clang import cindex

    flags = ["-x", "c++", "-std=c++14", "-w", *(f"-I{folder}" for folder in includes)]
    flags += [f"-iquote{folder}" for folder in quotes]
    flags += ["-isystem", max(map(str, Path("/usr/lib/gcc/x86_64-linux-gnu").glob("*/include")))]
    unit = cindex.Index.create().parse(str(path), args=flags)
    if any(diagnostic.severity >= cindex.Diagnostic.Error for diagnostic in unit.diagnostics):
        return None
    text = path.read_bytes()
    return [
        (cursor.location.line, cursor.spelling, 1 + len(set(decisions(cursor, text, str(path)))))
        for cursor in functions(unit.cursor, str(path))
    ]


def functions(top: Any, path: str) -> Iterator[Any]:
    """Yield every function definition in the main file; lambdas belong to the function around them."""
    from clang.cindex import CursorKind as Kind

    kinds = (
        Kind.FUNCTION_DECL,
        Kind.CXX_METHOD,
        Kind.CONSTRUCTOR,
        Kind.DESTRUCTOR,
        Kind.CONVERSION_FUNCTION,
        Kind.FUNCTION_TEMPLATE,
    )
    waiting = [top]
    while waiting:
        cursor = waiting.pop()
        for child in cursor.get_children():
            place = child.location.file
            if place is None or place.name != path:
                continue
            if child.kind in kinds and child.is_definition():
                yield child
            waiting.append(child)


def decisions(function: Any, text: bytes, path: str) -> Iterator[tuple[str, int]]:
    """Yield a name and the offset of each decision that is written in the file."""
    from clang.cindex import CursorKind as Kind

    words = {
        Kind.IF_STMT: b"if",
        Kind.FOR_STMT: b"for",
        Kind.CXX_FOR_RANGE_STMT: b"for",
        Kind.WHILE_STMT: b"while",
        Kind.DO_STMT: b"do",
        Kind.CASE_STMT: b"case",
        Kind.CXX_CATCH_STMT: b"catch",
    }
    waiting = list(function.get_children())
    while waiting:
        cursor = waiting.pop()
        children = list(cursor.get_children())
        waiting.extend(children)
        if word := words.get(cursor.kind):
            offset = written(cursor, path)
            if offset is not None and re.match(rb"%s\b" % word, text[offset : offset + 8]):
                yield word.decode(), offset
        elif cursor.kind == Kind.CONDITIONAL_OPERATOR:
            if offset := before(children[-1], rb":", text, path):
                yield "?", offset
        elif logical(cursor) and (offset := before(children[-1], rb"&&|\|\||\band\b|\bor\b", text, path)):
            yield "&&", offset


def logical(cursor: Any) -> bool:
    """Return whether the cursor is a built-in ``&&`` or ``||``."""
    from clang import cindex

    if cursor.kind != cindex.CursorKind.BINARY_OPERATOR:
        return False
    operator = cindex.conf.lib.clang_getCursorBinaryOperatorKind
    operator.argtypes, operator.restype = [cindex.Cursor], ctypes.c_int
    return operator(cursor) in (LOGICAL_AND, LOGICAL_OR)


def written(cursor: Any, path: str) -> int | None:
    """Return the offset at which the cursor's first token is spelled, if that is in the main file."""
    from clang import cindex

    start = cursor.extent.start
    file, offset = ctypes.c_void_p(), ctypes.c_uint()
    spelling = cindex.conf.lib.clang_getSpellingLocation
    spelling.argtypes = [cindex.SourceLocation, *[ctypes.c_void_p] * 4]
    spelling(start, ctypes.byref(file), None, None, ctypes.byref(offset))
    if not file.value:
        return None
    name = cindex.conf.lib.clang_getFileName
    name.argtypes = [ctypes.c_void_p]
    return int(offset.value) if str(name(file)) == path else None


def before(operand: Any, operator: bytes, text: bytes, path: str) -> int | None:
    """Return where the operator before ``operand`` is written, None where a macro wrote it."""
    offset = written(operand, path)
    if offset is None:
        return None
    head = re.sub(
        rb"/\*.*?\*/|//[^\n]*", lambda match: b" " * len(match[0]), text[max(0, offset - 400) : offset], flags=re.DOTALL
    )
    match = re.search(rb"(?:%s)[\s(!~*&+-]*$" % operator, head)
    return offset if match else None


if __name__ == "__main__":
    sys.exit(main())
