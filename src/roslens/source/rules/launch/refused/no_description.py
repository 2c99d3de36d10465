"""Rule ``launch.no_description``: a launch file in Python from which launch gets no description."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence

from roslens.model.source import Language
from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.extract.facts.refusal import Refusal
from roslens.source.extract.launch_python.refused_python import ENTRY, description_refusal
from roslens.source.rules.hit import Hit
from roslens.source.rules.package_view import PackageView
from roslens.source.rules.rule import PackageRule
from roslens.source.rules.views.launch_sources import LaunchSource, is_template, launch_sources, refusal_hit

_LAUNCH = re.compile(rb"^\s*(?:from|import)\s+(?:launch|launch_ros)\b", re.MULTILINE)
_LOADS = re.compile(rb"\b(?:runpy|importlib|imp)\b|\bSourceFileLoader\b|\bexec\s*\(")
"""What runs a file as a module, whatever it is named."""
_NAMED = ("_launch.py", ".launch.py")


def found(view: PackageView) -> Iterator[Hit]:
    """Yield each launch file whose ``generate_launch_description`` is missing or of no use."""
    if 2 not in view.ros:
        return
    files = list(launch_sources(view, Language.LAUNCH_PYTHON, Language.PYTHON))
    for file in files:
        if _is_launch_file(file):
            refusal = description_refusal(file.content)
            if refusal is None or not _is_meant(file, refusal) or is_template(file.content):
                continue
            if not _is_loaded(file, files):
                message = f"{refusal.what}: launch cannot start this file; expected {refusal.expected}"
                yield refusal_hit("launch.no_description", file.path, refusal, message)


def _is_launch_file(file: LaunchSource) -> bool:
    is_named = file.path.endswith(_NAMED) or "/launch/" in f"/{file.path}"
    return is_named and _LAUNCH.search(file.content) is not None


def _is_loaded(file: LaunchSource, files: Sequence[LaunchSource]) -> bool:
    """Return whether another file runs one as a module, by the name of the file: it has functions for others."""
    name = re.compile(rb"['\"/]%s['\"]" % re.escape(file.path.rpartition("/")[2].encode()))
    return any(one is not file and _LOADS.search(one.content) and name.search(one.content) for one in files)


def _is_meant(file: LaunchSource, refusal: Refusal) -> bool:
    """Return whether a file is meant to be started: others hold what launch files import.

    What stands below the first line is a function of a name that is nearly right.
    """
    return ENTRY.encode() in file.content or file.path.endswith(".launch.py") or refusal.line > 1


RULE = PackageRule(
    id="launch.no_description",
    title="Launch file without a launch description",
    finds="A launch file in Python without `generate_launch_description`, with a function of nearly that name, or with "
    "one that takes arguments or returns nothing. Modules that launch files import, or run by the names of their "
    "files, are left out.",
    why="launch calls this function and nothing else: the file starts nothing.",
    consequence=Consequence.STOPS_START,
    certainty=Certainty.PROVEN,
    profiles=("ros2",),
    tags=("launch",),
    bad="from launch import LaunchDescription\n\n\ndef generate_launch_desciption():\n    return LaunchDescription([])",
    good="from launch import LaunchDescription\n\n\ndef generate_launch_description():\n    return "
    "LaunchDescription([])",
    found=found,
)
