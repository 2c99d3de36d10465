"""Rule ``launch.transform_arguments``: a command line that static_transform_publisher refuses."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.distributions.known_distributions import is_at_least
from roslens.source.rules.hit import Hit
from roslens.source.rules.package_view import PackageView
from roslens.source.rules.rule import PackageRule
from roslens.source.rules.views.launch_places import keyword_place

if TYPE_CHECKING:
    from roslens.source.extract.facts.launched import Launched
    from roslens.source.extract.facts.node_facts import Evidence

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
_OF_ROS_1 = {"tf": frozenset({9, 10}), "tf2_ros": frozenset({1, 8, 9})}
"""How many words the programs of ROS 1 take; that of tf2_ros takes the name of a parameter as well."""
_EXPECTED = {"tf": "9 or 10", "tf2_ros": "8 or 9"}
_DEPRECATED, _REMOVED = "humble", "lyrical"
_Words = Sequence[str | None]


def found(view: PackageView) -> Iterator[Hit]:
    """Yield each static_transform_publisher whose words are known and refused, once for each place."""
    yield from _of_ros1(view)
    said: set[tuple[str, int]] = set()
    for run in view.launch_runs:
        for node in run.launch.nodes if _PROGRAM.encode() in run.content else ():
            at = node.evidence
            if at.path not in view.by_path or (at.path, at.line) in said or not _is_publisher(node):
                continue
            words = _own([one.known for one in node.arguments])
            if reason := refused(words):
                said.add((at.path, at.line))
                message = (
                    f"{_PROGRAM} ends at once: {reason}; expected --x, --y, --z, --roll, --pitch, --yaw (or "
                    "--qx … --qw), --frame-id and --child-frame-id, each with a value"
                )
                line, column = keyword_place(view, at, "arguments")
                yield Hit("launch.transform_arguments", message, line, column, context=reason, path=at.path)
            elif by_position := _by_position(words, at, view):
                said.add((at.path, at.line))
                yield by_position


def _by_position(words: _Words, at: Evidence, view: PackageView) -> Hit | None:
    """Return a hit at words by position, which Humble deprecated and Lyrical removed (ros2/geometry2#790)."""
    is_whole = len(words) in (_BY_ANGLES, _BY_QUATERNION) and not any((one or "").startswith("--") for one in words)
    target = view.around.target
    names = target.of(2)
    if not is_whole or (names and not any(is_at_least(one, _DEPRECATED) for one in names)):
        return None
    is_gone = any(is_at_least(one, _REMOVED) for one in names)
    because = f"this package is built for it, as {target.said_by} says; " if is_gone else ""
    message = (
        f"{_PROGRAM} takes {len(words)} words by position: deprecated since Humble and removed in Lyrical, where it "
        f"ends at once; {because}expected --x … --yaw, --frame-id and --child-frame-id, each with a value"
    )
    certainty = Certainty.HEURISTIC
    if is_gone:
        certainty = Certainty.PROVEN if target.given else Certainty.LIKELY
    line, column = keyword_place(view, at, "arguments")
    return Hit(
        "launch.transform_arguments", message, line, column, context="by position", path=at.path,
        certainty=certainty, consequence=None if is_gone else Consequence.HARD_TO_MAINTAIN,
    )  # fmt: skip


def _of_ros1(view: PackageView) -> Iterator[Hit]:
    """Yield each start in a launch file of ROS 1 with too few or too many words; what is substituted is let be."""
    for file in view.launch if view.ros == frozenset({1}) else ():
        for element, _ in file.elements:
            attributes = element.attributes
            numbers = _OF_ROS_1.get(attributes.get("pkg", "")) if attributes.get("type") == _PROGRAM else None
            given = attributes.get("args", "")
            words = [word for word in given.split() if ":=" not in word]
            if numbers is None or "$(" in given or len(words) in numbers or file.is_test:
                continue
            expected, end = _EXPECTED[attributes["pkg"]], " and a period in ms" if attributes["pkg"] == "tf" else ""
            message = (
                f"{_PROGRAM} of {attributes['pkg']} ends at once: it is given {len(words)} words; expected {expected}: "
                f"a position, three angles or a quaternion, two frames{end}"
            )
            yield file.hit("launch.transform_arguments", element, message, given[:80])


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
    "with the defaults of their arguments; unknown words are let be. Words by position are reported where the package "
    "is built for a distribution that has them no more, and are a note elsewhere. In launch files of ROS 1 the number "
    "of words is asked: the program of tf takes a period at the end, that of tf2_ros none.",
    why="The program ends at once, and every transform through its frames is missing.",
    consequence=Consequence.WRONG,
    certainty=Certainty.PROVEN,
    profiles=("ros2", "ros1"),
    tags=("launch", "transform"),
    bad='<node pkg="tf2_ros" exec="static_transform_publisher" args="0 0 1 0 0 0 base_link camera 100"/>',
    good='<node pkg="tf2_ros" exec="static_transform_publisher"\n'
    '      args="--z 1 --frame-id base_link --child-frame-id camera"/>',
    found=found,
)
