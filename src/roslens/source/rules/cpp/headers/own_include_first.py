"""Rule ``cpp.own_include_first``: a source file that does not read its own header first."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import PurePosixPath

from roslens.model.edit import Edit, edit_at
from roslens.model.source import Language, Role
from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.hit import Hit
from roslens.source.rules.include_lines import above_comments, include_lines
from roslens.source.rules.package_view import PackageView
from roslens.source.rules.rule import PackageRule
from roslens.source.syntax.comments import blank_comments

_HEADERS = frozenset({".h", ".hh", ".hpp", ".hxx"})
_IF = re.compile(rb"^[ \t]*#[ \t]*(?:if|else|endif)", re.MULTILINE)
_SOURCES = frozenset({".cpp", ".cc", ".cxx"})


def found(view: PackageView) -> Iterator[Hit]:
    """Yield each source file whose own header stands behind another include, or nowhere."""
    headers = {
        PurePosixPath(file.path).stem: file.path
        for file in view.of_language(Language.CPP, Language.C, roles=(Role.OWN,))
        if PurePosixPath(file.path).suffix in _HEADERS
    }
    for file in view.of_language(Language.CPP, roles=(Role.OWN,)):
        path, facts = PurePosixPath(file.path), view.facts.get(file.path)
        own = headers.get(path.stem)
        if path.suffix not in _SOURCES or own is None or facts is None or not facts.includes:
            continue
        names = [name.strip('<>"') for name, _ in facts.includes]
        at = next(
            (
                i
                for i, name in enumerate(names)
                if PurePosixPath(name).stem == path.stem and own.endswith(name.lstrip("./"))
            ),
            -1,
        )
        if at == 0:
            continue
        line = facts.includes[at][1] if at > 0 else facts.includes[0][1]
        what = f"`{names[at]}` is include {at + 1}" if at > 0 else f"`{PurePosixPath(own).name}` is not included"
        yield Hit(
            "cpp.own_include_first",
            f"{what}; expected the own header first",
            line,
            context=path.stem,
            path=file.path,
            edits=_moved(view.read(file.path), names[at], file.path) if at > 0 else (),
        )


def _moved(content: bytes, name: str, path: str) -> tuple[Edit, ...]:
    """Return what puts an include before all others, where nothing but includes stands between."""
    lines = include_lines(content, blank_comments(content, "cpp"))
    own = next((one for one in lines.lines if one.name.strip('<>"') == name), None)
    if own is None or own.conditional or lines.lines[0].conditional or not content[own.start : own.end].isascii():
        return ()
    first = lines.lines[0]
    if any(at < own.start for at in lines.other) or _IF.search(content, first.start, own.start):
        return ()
    text = content[own.start : own.end].decode().strip()
    # A blank line that is left behind would be the second one in a row.
    end = own.end
    if content[: own.start].replace(b"\r", b"").endswith(b"\n\n") and content[end : end + 2].lstrip(b"\r")[:1] == b"\n":
        end = content.index(b"\n", end) + 1
    at = above_comments(content, first.start)
    is_next = own == lines.lines[1] and at == first.start
    blank = "" if is_next and content[first.end : first.end + 2].lstrip(b"\r")[:1] == b"\n" else "\n"
    return (
        edit_at(content, at, at, f"{text}\n{blank}", path),
        edit_at(content, own.start, end, "", path),
    )


RULE = PackageRule(
    id="cpp.own_include_first",
    title="Own header not included first",
    finds="A source file whose own header, of the same name in the package, is not its first include, or is not "
    "included at all. Include it first.",
    why="A header that cannot stand alone is found where it is made, not by the first user who includes it alone.",
    consequence=Consequence.STYLE,
    certainty=Certainty.PROVEN,
    profiles=(
        "google",
        "ros-style",
        "paper2016",
    ),
    clauses=(
        "cpplint build/include",
        "paper2016 include_own_header",
    ),
    fix="Moves the include to the front, where nothing but includes stands before it. That the header can "
    "then stand alone is for the compiler to say.",
    bad='#include <vector>\n#include "robot/driver.h"\n',
    good='#include "robot/driver.h"\n#include <vector>\n',
    found=found,
)
