"""Packages that are written for Python 2 as a whole: their distribution has it, and has nothing else.

What one file that was left behind in a package for Python 3 cannot do is a mistake; that none of a package's files can
is how old it is.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import msgspec

from roslens.model.finding import Severity
from roslens.model.source import Language, Role
from roslens.source.rules.hit import Hit
from roslens.source.rules.package_view import PackageView

_SYNTAX = "python.python2_syntax"
_RULES = frozenset({_SYNTAX, "python.python2_name", "python.yaml_load"})
_LEAST = 2
_SHARE = 0.5


def as_notes_where_all_is_python2(placed: Mapping[str, Sequence[Hit]], view: PackageView) -> dict[str, list[Hit]]:
    """Return hits by path; those on Python 2 are notes where at least half of a ROS 1 package's files cannot be read.

    Args:
        placed: hits of rules in the files of a package.
        view: the package.
    """
    old = [path for path, hits in placed.items() if any(hit.rule == _SYNTAX for hit in hits)]
    files = view.of_language(Language.PYTHON, roles=(Role.OWN,))
    if 2 in view.ros or len(old) < _LEAST or len(old) < _SHARE * len(files):
        return {path: list(hits) for path, hits in placed.items()}
    return {path: [_as_note(hit) for hit in hits] for path, hits in placed.items()}


def _as_note(hit: Hit) -> Hit:
    return msgspec.structs.replace(hit, severity=Severity.NOTE) if hit.rule in _RULES else hit
