# Copyright 2025 The roslens authors
#
# Licensed under the Apache License, Version 2.0 (the "License");
# you may not use this file except in compliance with the License.
# You may obtain a copy of the License at
#
#     http://www.apache.org/licenses/LICENSE-2.0
#
# Unless required by applicable law or agreed to in writing, software
# distributed under the License is distributed on an "AS IS" BASIS,
# WITHOUT WARRANTIES OR CONDITIONS OF ANY KIND, either express or implied.
# See the License for the specific language governing permissions and
# limitations under the License.

"""Missions as files: YAML in, checked waypoints out."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import yaml

FARTHEST_M = 500.0


class MissionError(ValueError):
    """A mission file does not say what it must."""


@dataclass(frozen=True)
class Waypoint:
    """A place to drive to; ``hold_s`` above 0 means to rest there."""

    name: str
    x: float
    y: float
    tolerance_m: float = 0.25
    hold_s: float = 0.0

    def distance_to(self, other: Waypoint) -> float:
        """Return the distance in metres."""
        return math.hypot(other.x - self.x, other.y - self.y)


@dataclass(frozen=True)
class Mission:
    """Waypoints in order."""

    frame: str
    waypoints: tuple[Waypoint, ...] = field(default=())
    loop: bool = False

    @property
    def length_m(self) -> float:
        """Length of the way from the first waypoint to the last."""
        pairs = zip(self.waypoints, self.waypoints[1:])
        return sum(first.distance_to(second) for first, second in pairs)


def load_mission(path: Path) -> Mission:
    """Read and check a mission file.

    Raises:
        MissionError: the file is no mission; the message says where and what was expected.
    """
    try:
        document = yaml.safe_load(path.read_text(encoding="utf-8"))
    except (OSError, UnicodeDecodeError, yaml.YAMLError) as error:
        raise MissionError(f"{path}: cannot be read: {error}") from error
    if not isinstance(document, dict):
        raise MissionError(f"{path}: expected a mapping with 'frame' and 'waypoints'")
    unknown = sorted(set(document) - {"frame", "waypoints", "loop"})
    if unknown:
        raise MissionError(f"{path}: unknown key '{unknown[0]}'")
    entries = document.get("waypoints")
    if not isinstance(entries, list) or not entries:
        raise MissionError(f"{path}: 'waypoints' has to be a list with at least one entry")
    waypoints = tuple(_waypoint(entry, f"{path}: waypoint {number}") for number, entry in enumerate(entries, 1))
    names = [waypoint.name for waypoint in waypoints]
    doubled = sorted({name for name in names if names.count(name) > 1})
    if doubled:
        raise MissionError(f"{path}: two waypoints are called '{doubled[0]}'")
    return Mission(str(document.get("frame", "odom")), waypoints, bool(document.get("loop", False)))


def _waypoint(entry: Any, where: str) -> Waypoint:
    if not isinstance(entry, dict) or "at" not in entry:
        raise MissionError(f"{where}: expected a mapping with 'at: [x, y]'")
    place = entry["at"]
    if not isinstance(place, list) or len(place) != 2:
        raise MissionError(f"{where}: 'at' has to be [x, y] in metres")
    x, y = (_number(value, where) for value in place)
    if math.hypot(x, y) > FARTHEST_M:
        raise MissionError(f"{where}: is farther away than {FARTHEST_M:.0f} m")
    return Waypoint(
        name=str(entry.get("name", f"({x:g}, {y:g})")),
        x=x,
        y=y,
        tolerance_m=_number(entry.get("tolerance_m", 0.25), where),
        hold_s=_number(entry.get("hold_s", 0.0), where),
    )


def _number(value: Any, where: str) -> float:
    if isinstance(value, bool) or not isinstance(value, (int, float)) or not math.isfinite(value):
        raise MissionError(f"{where}: '{value}' is no number")
    return float(value)
