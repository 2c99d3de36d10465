"""Rule ``package.bridge_entry``: an entry of a bridge that makes no bridge."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from typing import Any

from roslens.intake.safe_yaml import UnsafeYamlError, load_yaml
from roslens.model.source import Language, Role
from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.hit import Hit
from roslens.source.rules.package_view import PackageView
from roslens.source.rules.rule import PackageRule
from roslens.source.rules.views.gazebo_types import refused_pair, unknown_message

_ID = "package.bridge_entry"
_ROS, _GAZEBO, _WAY = "ros_type_name", "gz_type_name", "direction"
_WAYS = ("BIDIRECTIONAL", "GZ_TO_ROS", "ROS_TO_GZ")
_OLD_WAYS = ("IGN_TO_ROS", "ROS_TO_IGN")
"""Of ros_ign, which had ``ign_type_name`` too."""
_TOPICS = "topics"
_LISTS = frozenset({_TOPICS, "services_1_to_2", "services_2_to_1"})
"""What a file for ros1_bridge consists of (``doc/parameter_bridge.rst``)."""

_Told = tuple[str, str, Certainty | None]


def found(view: PackageView) -> Iterator[Hit]:
    """Yield each entry of a file for a bridge that the bridge refuses or that names a type which does not exist."""
    for file in view.of_language(Language.YAML, roles=(Role.OWN,)):
        content = view.read(file.path)
        if _ROS.encode() not in content and _TOPICS.encode() not in content:
            continue
        try:
            document = load_yaml(content)
        except (UnsafeYamlError, RecursionError):
            continue
        text = content.decode("utf-8", "replace")
        for entry, reason, word, sure in _refused(document):
            line = _line(text, entry, word)
            yield Hit(_ID, reason, line, context=reason, path=file.path, certainty=sure)


def _refused(document: Any) -> Iterator[tuple[Mapping[str, Any], str, str, Certainty | None]]:
    """Yield entries with why they are refused, the word that is wrong, and how sure that is."""
    match document:
        case list():
            told = ((one, _of_gazebo(one)) for one in document if isinstance(one, dict) and _ROS in one)
        case dict() if set(document) <= _LISTS and isinstance(document.get(_TOPICS), list):
            told = ((one, _of_ros1(one)) for one in document[_TOPICS] if isinstance(one, dict))
        case _:
            return
    yield from ((one, *why) for one, why in told if why is not None)


def _of_ros1(one: Mapping[str, Any]) -> _Told | None:
    kind = one.get("type")
    reason = unknown_message(kind) if isinstance(kind, str) else ""
    return (f"{reason}: no bridge is made", str(kind), Certainty.LIKELY) if reason else None


def _of_gazebo(one: Mapping[str, Any]) -> _Told | None:
    way = one.get(_WAY, _WAYS[0])
    if way not in _WAYS and way not in _OLD_WAYS:
        return f"{_WAY} {way!r} is none: no bridge is made; expected one of {', '.join(_WAYS)}", str(way), None
    both = next((name for name in ("ros_topic_name", "gz_topic_name") if name in one and "topic_name" in one), "")
    if both:
        return f"'topic_name' and {both!r} exclude each other: no bridge is made; expected one of them", both, None
    ros, gazebo = one.get(_ROS), one.get(_GAZEBO)
    if not isinstance(ros, str) or not isinstance(gazebo, str):
        # Services, which newer versions take, have other keys.
        return None
    if "/srv/" in ros or not (reason := refused_pair(ros, gazebo)):
        return None
    return f"{reason}: no bridge is made", ros, Certainty.LIKELY


def _line(text: str, entry: Mapping[str, Any], word: str) -> int:
    """Return the line of a word behind the first words that are in no other entry."""
    start = 0
    for name in ("topic_name", "ros_topic_name", "topic", "gz_topic_name"):
        value = entry.get(name)
        match = re.search(rf"\b{name}\s*:\s*[\"']?{re.escape(str(value))}[\"']?\s*(?:#.*)?$", text, re.MULTILINE)
        if value is not None and match is not None:
            start = text.rfind("\n-", 0, match.start()) + 1
            break
    at = re.search(rf"(?<![\w/]){re.escape(word)}(?![\w/])", text[start:])
    return text.count("\n", 0, start + (at.start() if at is not None else 0)) + 1


RULE = PackageRule(
    id=_ID,
    title="Entry of a bridge that makes no bridge",
    finds="An entry of a file for `ros_gz_bridge` (`ros_type_name`, `gz_type_name`) with a message that does not exist "
    "(`std_msgs/msg/float64`), a message of Gazebo that it is not converted into, a direction that is none, or two "
    "names that exclude each other; and a topic of a file for `ros1_bridge` with a message that does not exist.",
    why="The bridge writes a warning and goes on without the topic: the node that waits for it gets nothing.",
    consequence=Consequence.WRONG,
    certainty=Certainty.PROVEN,
    profiles=("ros2",),
    tags=("topics", "simulation"),
    bad='- ros_topic_name: "tilt"\n  gz_topic_name: "/tilt"\n  ros_type_name: "std_msgs/msg/float64"\n'
    '  gz_type_name: "gz.msgs.Double"',
    good='- ros_topic_name: "tilt"\n  gz_topic_name: "/tilt"\n  ros_type_name: "std_msgs/msg/Float64"\n'
    '  gz_type_name: "gz.msgs.Double"',
    found=found,
)
