"""Rule ``launch.transform_arguments``: a command line that static_transform_publisher refuses."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.hit import Hit
from roslens.source.rules.package_view import PackageView
from roslens.source.rules.rule import PackageRule

if TYPE_CHECKING:
    from roslens.source.extract.facts.launched import Launched

_PROGRAM = "static_transform_publisher"
_TRANSLATION = ("--x", "--y", "--z")
_ANGLES = ("--roll", "--pitch", "--yaw")
_QUATERNION = ("--qx", "--qy", "--qz", "--qw")
_FRAMES = ("--frame-id", "--child-frame-id")
_OPTIONS = frozenset((*_TRANSLATION, *_ANGLES, *_QUATERNION, *_FRAMES))
_NUMBER = re.compile(r"\s*[-+]?(?:\d|\.\d|inf|nan)", re.IGNORECASE)
"""What ``std::stod`` takes, whatever comes behind."""
_BY_ANGLES, _BY_QUATERNION = 8, 9
"""Words of the older form: a position, a rotation and two frames."""
_Words = Sequence[str | None]


def found(view: PackageView) -> Iterator[Hit]:
    """Yield each static_transform_publisher whose words are known and refused, once for each place."""
    said: set[tuple[str, int]] = set()
    for run in view.launch_runs:
        for node in run.launch.nodes if _PROGRAM.encode() in run.content else ():
            at = node.evidence
            if at.path not in view.by_path or (at.path, at.line) in said or not _is_publisher(node):
                continue
            if reason := refused(_own([one.known for one in node.arguments])):
                said.add((at.path, at.line))
                message = (
                    f"{_PROGRAM} ends at once: {reason}; expected --x, --y, --z, --roll, --pitch, --yaw (or "
                    "--qx … --qw), --frame-id and --child-frame-id, each with a value"
                )
                yield Hit("launch.transform_arguments", message, at.line, at.column, context=reason, path=at.path)


def _is_publisher(node: Launched) -> bool:
    return node.package.known == "tf2_ros" and node.executable.known == _PROGRAM and bool(node.arguments)


def _own(words: _Words) -> _Words:
    """Return the words without those for rcl: from ``--ros-args`` up to the next ``--``."""
    found: list[str | None] = []
    is_own = True
    for word in words:
        if word == "--ros-args":
            is_own = False
        elif not is_own and word == "--":
            is_own = True
        elif is_own:
            found.append(word)
    return found


def refused(words: _Words) -> str:
    """Return why the program refuses its words, as ``parse_args`` of tf2_ros does; empty where it takes them.

    Args:
        words: of the command line, None for those that are unknown.
    """
    if "--help" in words or "-h" in words:
        return ""
    options: dict[str, str | None] = {}
    rest: list[str | None] = []
    given = iter(words)
    for word in given:
        if word not in _OPTIONS:
            rest.append(word)
            continue
        value = next(given, "")
        if value == "":
            return f"{word} has no value"
        if word not in _FRAMES and value is not None and not _NUMBER.match(value):
            return f"{value!r} is given for {word}, which is no number"
        options[word] = value
    if None in rest:
        # An unknown word may be an option as well.
        return ""
    return _of_options(options, [word for word in rest if word is not None])


def _of_options(options: dict[str, str | None], rest: Sequence[str]) -> str:
    if any(one in options for one in _ANGLES) and any(one in options for one in _QUATERNION):
        return "it is given angles and a quaternion"
    if len(rest) in (_BY_ANGLES, _BY_QUATERNION):
        if any(one in options for one in (*_TRANSLATION, *_QUATERNION, *_FRAMES)):
            return f"it is given options, and {len(rest)} words without one"
        if wrong := next((one for one in rest[:-2] if not _NUMBER.match(one)), None):
            return f"{wrong!r} is no number, and {len(rest)} words are a position, a rotation and two frames"
        return ""
    if rest:
        words = " ".join(rest) if len(rest) < _BY_ANGLES else f"{len(rest)} words"
        return f"`{words}` is no option with its value"
    missing = next((one for one in _FRAMES if one not in options), None)
    return f"{missing} is missing" if missing else ""


RULE = PackageRule(
    id="launch.transform_arguments",
    title="Command line that static_transform_publisher refuses",
    finds="A launch file of ROS 2 that starts `static_transform_publisher` of tf2_ros with words that it does not "
    "take: an option that it does not have, a value that is missing or no number, angles beside a quaternion, the "
    "older form with a word too many or too few (as with the period of ROS 1), no frame. Launch files are evaluated "
    "with the defaults of their arguments; unknown words are let be.",
    why="The program ends at once, and every transform through its frames is missing.",
    consequence=Consequence.WRONG,
    certainty=Certainty.PROVEN,
    profiles=("ros2",),
    tags=("launch", "transform"),
    bad='<node pkg="tf2_ros" exec="static_transform_publisher" args="0 0 1 0 0 0 base_link camera 100"/>',
    good='<node pkg="tf2_ros" exec="static_transform_publisher"\n'
    '      args="--z 1 --frame-id base_link --child-frame-id camera"/>',
    found=found,
)
