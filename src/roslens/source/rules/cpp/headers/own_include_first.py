"""Rule ``cpp.own_include_first``: a source file that does not read its own header first."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import PurePosixPath

from roslens.model.finding import Severity
from roslens.model.source import Language, Role
from roslens.source.rules.hit import Hit
from roslens.source.rules.package_view import PackageView
from roslens.source.rules.rule import PackageRule

_HEADERS = frozenset({".h", ".hh", ".hpp", ".hxx"})
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
            "cpp.own_include_first", f"{what}; expected the own header first", line, context=path.stem, path=file.path
        )


RULE = PackageRule(
    id="cpp.own_include_first",
    title="Own header not included first",
    finds="A source file whose own header, of the same name in the package, is not its first include, or is not "
    "included at all. Include it first.",
    why="A header that cannot stand alone is found where it is made, not by the first user who includes it alone.",
    severity=Severity.NOTE,
    profiles=(
        "google",
        "ros-style",
        "paper2016",
    ),
    clauses=(
        "cpplint build/include",
        "paper2016 include_own_header",
    ),
    bad='#include <vector>\n#include "robot/driver.h"\n',
    good='#include "robot/driver.h"\n#include <vector>\n',
    found=found,
)
