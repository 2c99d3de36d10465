"""Files of a package that nothing starts, imports or loads: what is wrong in them happens on no robot yet.

Such a file is named by no other file of the package, by no launch file of the workspace and in no text. A script counts
as started by hand where it has a ``#!`` line and may be executed, or a main part that ``python3 FILE`` runs in a
package for ROS 2; a file that another package could import or load is left where any depends on this one.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from pathlib import Path, PurePosixPath

import msgspec

from roslens.model.source import OUTSIDE_PACKAGES, Language
from roslens.model.weight.consequence import Certainty
from roslens.source.rules.hit import Hit
from roslens.source.rules.package_view import PackageView
from roslens.source.workspace.command_texts import command_texts

_OF_SCRIPTS = frozenset({"python.undefined_name", "python.unset_attribute", "python.unbound_local"})
_OF_ROBOTS = frozenset({"package.robot_tree"})
_MAIN = re.compile(rb"""^if\s+__name__\s*==\s*["']__main__["']""", re.MULTILINE)
_COMPUTED = re.compile(rb"""(?:[)}+%]\s*f?["']?|^f?["'])\.(?:urdf|xacro|xml)""", re.MULTILINE)
"""The name of a description that a launch file puts together: any may be meant."""
_EXECUTABLE = 0o111
_TEXT = frozenset({"", ".cfg", ".toml", ".txt", ".in", ".cmake", ".json", ".rviz", ".sh", ".md", ".rst", ".bash"})
"""Endings of files without a language that may name others."""
_NOTHING = "; no other file names this one"


def as_notes_where_nothing_starts(placed: Mapping[str, Sequence[Hit]], view: PackageView) -> dict[str, list[Hit]]:
    """Return hits by path; what a program or a robot needs is a note in a file that nothing starts or loads.

    Args:
        placed: hits of rules in the files of a package.
        view: the package.
    """
    found = {path: list(hits) for path, hits in placed.items()}
    if view.package.id == OUTSIDE_PACKAGES or view.around.asked_by:
        return found
    for path, hits in found.items():
        asked = _OF_SCRIPTS if path.endswith(".py") else _OF_ROBOTS
        if any(hit.rule in asked for hit in hits) and not _is_started(path, view):
            found[path] = [_as_note(hit) if hit.rule in asked else hit for hit in hits]
    return found


def _as_note(hit: Hit) -> Hit:
    return msgspec.structs.replace(hit, certainty=Certainty.HEURISTIC, message=f"{hit.message}{_NOTHING}")


def _is_started(path: str, view: PackageView) -> bool:
    content = view.read(path)
    if path.endswith(".py") and _is_started_by_hand(path, content, view):
        return True
    # Programs and modules are named without their ending.
    file = PurePosixPath(path)
    name = file.name.partition(".")[0] if path.endswith(".py") else file.name
    named = re.compile(rb"\b%b\b" % re.escape(name.encode()))
    texts = list(_others(path, view))
    is_computed = not path.endswith(".py") and any(map(_COMPUTED.search, texts))
    return is_computed or any(map(named.search, texts))


def _is_started_by_hand(path: str, content: bytes, view: PackageView) -> bool:
    is_program = content.startswith(b"#!")
    if not is_program:
        return _MAIN.search(content) is not None and 2 in view.ros
    try:
        return bool(Path(view.root, path).stat().st_mode & _EXECUTABLE)
    except OSError:
        return True


def _others(path: str, view: PackageView) -> Iterator[bytes]:
    """Yield the contents of all other files that may name one."""
    paths: Iterable[str] = (
        *(one for one, file in view.by_path.items() if file.language is not Language.MSG),
        *(one for one in view.others if PurePosixPath(one).suffix in _TEXT),
        *view.around.started.paths,
        *command_texts(view.root, view.folder, (view.path(one) for one in view.listing)),
    )
    return (view.read(one) for one in dict.fromkeys(paths) if one != path)
