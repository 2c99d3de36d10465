"""Rule ``cpp.guard_name``: a header guard that is not named after its file."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import PurePosixPath

from roslens.model.finding import Severity
from roslens.model.source import Language, Role
from roslens.source.rules.hit import Hit
from roslens.source.rules.package_view import PackageView
from roslens.source.rules.rule import PackageRule

_GUARD = re.compile(rb"^[ \t]*#[ \t]*ifndef[ \t]+(\w+)[^\n]*\n(?:[ \t]*\n)*[ \t]*#[ \t]*define[ \t]+\1\b", re.MULTILINE)
_END = re.compile(rb"#[ \t]*endif([^\n]*)\s*\Z")
_HEADERS = frozenset({".h", ".hh", ".hpp", ".hxx"})


def found(view: PackageView) -> Iterator[Hit]:
    """Yield each guard that is named otherwise, or whose end is not named."""
    for file in view.of_language(Language.CPP, Language.C, roles=(Role.OWN,)):
        path = PurePosixPath(file.path)
        if path.suffix not in _HEADERS:
            continue
        text = view.read(file.path)
        match = _GUARD.search(text)
        if match is None:
            continue
        name = match[1].decode("utf-8", "replace")
        wanted = re.sub(r"\W", "_", path.name).upper()
        line = text.count(b"\n", 0, match.start(1)) + 1
        if _plain(wanted) not in _plain(name):
            yield Hit(
                "cpp.guard_name",
                f"guard `{name}`; expected one that ends in `{wanted}_`",
                line,
                context=name,
                path=file.path,
            )
        end = _END.search(text)
        if end is not None and match[1] not in end[1]:
            last = text.count(b"\n", 0, end.start()) + 1
            message = f"the end of guard `{name}` does not name it; expected `#endif  // {name}`"
            yield Hit("cpp.guard_name", message, last, context=f"end {name}", path=file.path)


def _plain(name: str) -> str:
    return re.sub(r"[^A-Z0-9]", "", name.upper())


RULE = PackageRule(
    id="cpp.guard_name",
    title="Name of the header guard",
    finds="A header guard whose name does not end with the name of the file, or whose `#endif` does not name "
    "it. `#pragma once` is let be.",
    why="Two headers with one guard: the second one is empty, and nothing says so.",
    severity=Severity.NOTE,
    profiles=(
        "google",
        "ros-style",
        "paper2016",
    ),
    clauses=(
        "cpplint build/header_guard",
        "paper2016 header_guard_format",
        "paper2016 header_guard_close",
    ),
    bad="#ifndef OTHER_H_\n#define OTHER_H_\n#endif\n",
    good="#ifndef ROBOT_DRIVER_H_\n#define ROBOT_DRIVER_H_\n#endif  // ROBOT_DRIVER_H_\n",
    found=found,
)
