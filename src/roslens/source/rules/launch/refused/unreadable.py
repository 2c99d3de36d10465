"""Rule ``launch.unreadable``: a launch file that launch or roslaunch cannot read."""

from __future__ import annotations

import re
from collections.abc import Iterator
from difflib import get_close_matches

from roslens.model.source import Language
from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.extract.facts.refusal import Refusal
from roslens.source.extract.launch.refused_xml import refused_xml
from roslens.source.extract.launch.refused_yaml import refused_yaml
from roslens.source.extract.launch_python.refused_python import syntax_refusal
from roslens.source.rules.hit import Hit
from roslens.source.rules.package_view import PackageView
from roslens.source.rules.rule import PackageRule
from roslens.source.rules.views.launch_sources import LaunchSource, is_template, launch_sources, refusal_hit
from roslens.source.rules.views.package_files import MOST_BYTES

_COMMENT = re.compile(rb"<!--.*?-->|<\?.*?\?>|<![A-Z].*?>", re.DOTALL)
_TAG = re.compile(rb"<\s*([\w:.-]+)")


def found(view: PackageView) -> Iterator[Hit]:
    """Yield the first fault of each launch file that cannot be read."""
    for file in launch_sources(view, Language.LAUNCH_XML, Language.LAUNCH_YAML, Language.LAUNCH_PYTHON):
        if (size := view.by_path[file.path].size) > MOST_BYTES:
            message = f"{size:,} bytes: what this file starts is not judged; expected at most {MOST_BYTES:,}"
            yield Hit("launch.unreadable", message, 1, 1, path=file.path, certainty=Certainty.HEURISTIC)
            continue
        refusal = _refused(file)
        if refusal is not None and not is_template(file.content):
            yield refusal_hit("launch.unreadable", file.path, refusal, _message(refusal, file), _certainty(file))


def _refused(file: LaunchSource) -> Refusal | None:
    if file.path.endswith(".py"):
        return syntax_refusal(file.content)
    if file.path.endswith((".yaml", ".yml")):
        return refused_yaml(file.content) if file.is_ros2 else None
    return _of_xml(file)


def _of_xml(file: LaunchSource) -> Refusal | None:
    content = file.content
    # Files called .launch may be of other programs, and of other formats.
    if content.strip() and not content.lstrip(b"\xef\xbb\xbf \t\r\n").startswith(b"<"):
        return None
    root = _TAG.search(_COMMENT.sub(b"", content))
    tag = root[1].decode("utf-8", "replace") if root else "launch"
    if tag != "launch" and not get_close_matches(tag.lower(), ("launch",), 1, 0.7):
        return None
    refusal = refused_xml(content, in_utf8=file.is_ros2)
    if refusal is None and tag != "launch" and root is not None:
        at = content.find(root[0])
        line = content.count(b"\n", 0, at) + 1
        return Refusal(line, at - content.rfind(b"\n", 0, at), f"<{tag}> as the outermost element", "<launch>")
    return refusal


def _certainty(file: LaunchSource) -> Certainty | None:
    """Return a note for a file without content, which is a place for what somebody wants to write."""
    return Certainty.HEURISTIC if not _COMMENT.sub(b"", file.content).strip() else None


def _message(refusal: Refusal, file: LaunchSource) -> str:
    reader = "launch" if file.is_ros2 else "roslaunch"
    return f"{refusal.what}: {reader} cannot read this file and starts nothing of it; expected {refusal.expected}"


RULE = PackageRule(
    id="launch.unreadable",
    title="Launch file that cannot be read",
    finds="A launch file that is not well-formed XML, no YAML or no list of actions, no Python, or in ROS 2 not in "
    "UTF-8. Reported is the place at which the reader of launch or roslaunch gives up. Templates, "
    "tests, and files of other programs that are called `.launch` are left out; an empty file is a note, and "
    "so is one that is too large to be read here.",
    why="Whatever starts the file, and whatever includes it, ends at once.",
    consequence=Consequence.STOPS_START,
    certainty=Certainty.PROVEN,
    profiles=("ros2", "ros1"),
    tags=("launch",),
    bad='<launch>\n  <group>\n    <node pkg="base" exec="drive"/>\n</launch>',
    good='<launch>\n  <group>\n    <node pkg="base" exec="drive"/>\n  </group>\n</launch>',
    found=found,
)
