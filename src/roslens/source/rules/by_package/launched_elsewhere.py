"""Actions that a launch file makes and does not launch, where another file of the workspace starts the same program.

It was taken out because the other file starts it: the robot's state is published once. What invents joint states is not
needed either where a broadcaster of ros2_control publishes them.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence

import msgspec

from roslens.model.weight.consequence import Certainty
from roslens.source.rules.hit import Hit
from roslens.source.rules.package_view import PackageView

_RULE = "launch.unlaunched_action"
_PROGRAM = re.compile(r"\bexecutable\s*=\s*['\"]([\w.-]+)['\"]")
_INVENTED = re.compile(r"joint_state_publisher(?:_gui)?")
_BROADCASTER = "joint_state_broadcaster"
_NAMED = r"['\"]{}['\"]"
_STARTED = r"(?:executable\s*=\s*|\bexec\s*=\s*|\btype\s*=\s*|\bexec:\s*)['\"]?{}\b"


def as_notes_where_launched_elsewhere(placed: Mapping[str, Sequence[Hit]], view: PackageView) -> dict[str, list[Hit]]:
    """Return hits by path; an action that is not launched is a note where another file starts the same program.

    Args:
        placed: hits of rules in the files of a package.
        view: the package.
    """
    found = {path: list(hits) for path, hits in placed.items()}
    for path, hits in found.items():
        if any(hit.rule == _RULE for hit in hits):
            found[path] = [_weighed(hit, path, view) if hit.rule == _RULE else hit for hit in hits]
    return found


def _weighed(hit: Hit, path: str, view: PackageView) -> Hit:
    program = _program(hit, view.read(path))
    other = next(_starting(program, path, view), "") if program else ""
    if not other:
        return hit
    message = f"{hit.message}; {other}"
    return msgspec.structs.replace(hit, certainty=Certainty.HEURISTIC, message=message)


def _program(hit: Hit, content: bytes) -> str:
    """Return the program that the call at a hit starts; empty where it is not written out."""
    lines = content.decode("utf-8", "replace").splitlines()[hit.line - 1 : max(hit.end_line, hit.line)]
    match = _PROGRAM.search("\n".join(lines))
    return match[1] if match else ""


def _starting(program: str, path: str, view: PackageView) -> Iterator[str]:
    """Yield, for a message, that a launch file of the workspace starts a program or what takes its place."""
    started = re.compile(_STARTED.format(re.escape(program)))
    broadcast = re.compile(_NAMED.format(_BROADCASTER)) if _INVENTED.fullmatch(program) else None
    for other in view.around.started.paths:
        text = view.read(other).decode("utf-8", "replace")
        if other != path and started.search(text):
            yield f"{other} starts {program!r} as well"
        elif broadcast is not None and broadcast.search(text):
            yield f"{other} starts {_BROADCASTER!r}"
