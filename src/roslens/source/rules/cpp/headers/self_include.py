"""Rule ``cpp.self_include``: a header that includes itself."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import PurePosixPath

from roslens.model.source import Language
from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.hit import Hit
from roslens.source.rules.package_view import PackageView
from roslens.source.rules.rule import PackageRule
from roslens.source.rules.switched_off import switched_off
from roslens.source.syntax.comments import blank_comments

_GUARD = re.compile(
    rb"^[ \t]*#[ \t]*(?:pragma[ \t]+once\b"
    rb"|(?:ifndef[ \t]+|if[ \t]+!defined\b[ \t(]*)(\w+)[^\n]*\s+#[ \t]*define[ \t]+\1\b)",
    re.MULTILINE,
)


def found(view: PackageView) -> Iterator[Hit]:
    """Yield each include by which a header reads itself."""
    for file in view.of_language(Language.CPP, Language.C):
        facts = view.facts.get(file.path)
        for name, line in facts.includes if facts is not None else ():
            bare = name.strip('<>"')
            whole = "/" in bare and file.path.endswith(f"/{bare}")
            beside = name.startswith('"') and "/" not in bare and PurePosixPath(file.path).name == bare
            if whole or beside:
                yield from _hit(name, line, file.path, view)


def _hit(name: str, line: int, path: str, view: PackageView) -> Iterator[Hit]:
    """Yield the include, unless it is never compiled; behind a guard it does nothing, which makes a note of it."""
    code = blank_comments(view.read(path), "cpp")
    if any(line in lines for lines in switched_off(code)):
        return
    above = b"\n".join(code.split(b"\n")[: line - 1])
    bare = name.strip('<>"')
    message = f"`{bare}` includes itself; expected the header that was meant"
    certainty = Certainty.HEURISTIC if _GUARD.search(above) else None
    yield Hit("cpp.self_include", message, line, context=name, path=path, certainty=certainty)


RULE = PackageRule(
    id="cpp.self_include",
    title="Header that includes itself",
    finds="A header whose `#include` names itself. Remove it, or name the header that was meant. Behind a guard or "
    "`#pragma once` it is a note.",
    why="The header that was meant is missing, and its names come by luck. Behind a guard nothing else happens; "
    "without one the compiler ends, as the includes never do.",
    consequence=Consequence.HARD_TO_MAINTAIN,
    certainty=Certainty.PROVEN,
    profiles=(
        "ros2",
        "ros1",
        "safety",
    ),
    bad='// robot/driver.h\n#include "robot/driver.h"\n',
    good='#pragma once\n#include "robot/motor.h"\n',
    found=found,
)
