"""Packages of which nothing says that they are for Python 3: their distributions have Python 2, and nothing else.

What one file that was left behind in a package for Python 3 cannot do is a mistake; that nobody has brought a package
to Python 3 is how old it is. Of what lies outside of packages, nothing says it either.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import msgspec

from roslens.model.source import OUTSIDE_PACKAGES, Language, Role
from roslens.model.weight.consequence import Certainty
from roslens.source.rules.hit import Hit
from roslens.source.rules.package_view import PackageView

_RULES = frozenset(
    {"python.python2_syntax", "python.python2_name", "python.syntax", "python.yaml_load", "python.missing_module"}
)
_SINCE_NOETIC = 3
"""Format of manifests in which dependencies can depend on the version of Python."""
_NAMED = "python3"


def as_notes_without_python3(placed: Mapping[str, Sequence[Hit]], view: PackageView) -> dict[str, list[Hit]]:
    """Return hits by path; what Python 3 cannot do is a note in packages that nothing says to be for it.

    Args:
        placed: hits of rules in the files of a package.
        view: the package.
    """
    if any(hit.rule in _RULES for hits in placed.values() for hit in hits) and not _is_for_python3(view):
        return {path: [_as_note(hit) for hit in hits] for path, hits in placed.items()}
    return {path: list(hits) for path, hits in placed.items()}


def _is_for_python3(view: PackageView) -> bool:
    package = view.package
    if package.id == OUTSIDE_PACKAGES:
        return False
    if 1 not in view.ros or 2 in view.ros or package.format >= _SINCE_NOETIC:
        return True
    if any(one.name.startswith(_NAMED) for one in package.dependencies):
        return True
    files = view.of_language(Language.PYTHON, roles=(Role.OWN,))
    return any(_NAMED.encode() in view.read(file.path)[:100].partition(b"\n")[0] for file in files)


def _as_note(hit: Hit) -> Hit:
    return msgspec.structs.replace(hit, certainty=Certainty.HEURISTIC) if hit.rule in _RULES else hit
