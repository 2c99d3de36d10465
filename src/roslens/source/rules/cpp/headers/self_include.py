"""Rule ``cpp.self_include``: a header that includes itself."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import PurePosixPath

from roslens.model.source import Language
from roslens.source.rules.hit import Hit
from roslens.source.rules.package_view import PackageView
from roslens.source.rules.rule import PackageRule


def found(view: PackageView) -> Iterator[Hit]:
    """Yield each include by which a header reads itself."""
    for file in view.of_language(Language.CPP, Language.C):
        facts = view.facts.get(file.path)
        for name, line in facts.includes if facts is not None else ():
            bare = name.strip('<>"')
            whole = "/" in bare and file.path.endswith(f"/{bare}")
            beside = name.startswith('"') and "/" not in bare and PurePosixPath(file.path).name == bare
            if whole or beside:
                message = f"`{bare}` includes itself; expected the header that was meant"
                yield Hit("cpp.self_include", message, line, context=name, path=file.path)


RULE = PackageRule(
    id="cpp.self_include",
    title="Header that includes itself",
    finds="A header whose `#include` names itself. Remove it, or name the header that was meant.",
    why="The header that was meant is missing, and its names come by luck.",
    profiles=(
        "ros2",
        "ros1",
        "safety",
    ),
    bad='#pragma once\n#include "robot/driver.h"\n',
    good='#pragma once\n#include "robot/motor.h"\n',
    found=found,
)
