"""Puts a text that breaks a rule into a real file, at a place by chance."""

from __future__ import annotations

import ast
import re
from random import Random

import msgspec

from planted.variants import split
from roslens.model.source import Language
from roslens.source.parsed_file import parse_file
from roslens.source.settings import MacroSettings

_GUARD = re.compile(
    r"#\s*(?:ifndef|define)\s+(\w+_(?:H|HPP|HH|H_|HPP_|HXX|INCLUDED)\w*)[^\n]*\n|#\s*pragma\s+once[^\n]*\n"
)


class Planted(msgspec.Struct, frozen=True):
    """A real file with something in it.

    Attributes:
        content: of the file.
        first: line of what was put in; 1-based.
        last: line.
        head: lines at the beginning of the file that were put in as well, of includes.
    """

    content: str
    first: int
    last: int
    head: int = 0


def plant_cpp(host: str, text: str, random: Random) -> Planted | None:
    """Return a file with a text between two of its declarations and its includes on top; None without a place."""
    view = parse_file(host.encode(), Language.CPP, MacroSettings()).view()
    skipped = ("preproc_include", "comment", "preproc_def", "preproc_call", "preproc_function_def", "ERROR")
    places = []
    for node in view.top_level:
        start = node.start_byte
        before = view.content[:start]
        if node.type not in skipped and node.is_named and before.endswith(b"\n") and not before.endswith(b"\\\n"):
            places.append(start)
    if not places:
        return None
    at = random.choice(places)
    head, body = split(text.replace("#pragma once\n", ""))
    first = host.encode()[:at].decode()
    lines = first.count("\n") + head.count("\n")
    body = body if body.endswith("\n") else f"{body}\n"
    content = head + first + body + host.encode()[at:].decode()
    return Planted(content, lines + 1, lines + body.count("\n"), head.count("\n"))


def plant_python(host: str, text: str, random: Random) -> Planted | None:
    """Return a file with a text between two of its statements."""
    try:
        tree = ast.parse(host)
    except SyntaxError:
        return None
    starts = [min([one.lineno, *(deco.lineno for deco in getattr(one, "decorator_list", ()))]) for one in tree.body]
    future = [
        one.end_lineno or 0 for one in tree.body if isinstance(one, ast.ImportFrom) and one.module == "__future__"
    ]
    places = [one for one in starts[1:] if one > max(future, default=0)]
    if not places:
        return None
    line = random.choice(places)
    lines = host.splitlines(keepends=True)
    body = text if text.endswith("\n") else f"{text}\n"
    content = "".join((*lines[: line - 1], body, *lines[line - 1 :]))
    return Planted(content, line, line + body.count("\n") - 1)


def without_guard(host: str) -> Planted | None:
    """Return a header without what keeps it from being read twice; None where it has no such thing."""
    changed = _GUARD.sub("", host, count=2)
    if changed == host or "#include" not in changed or not re.search(r"^(?:class|struct) ", changed, re.MULTILINE):
        return None
    content = re.sub(r"#\s*endif[^\n]*\n\s*\Z", "", changed) if "pragma" not in host else changed
    return Planted(content, 1, content.count("\n"))
