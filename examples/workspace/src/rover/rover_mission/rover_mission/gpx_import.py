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

"""Missions from the tracks that hand-held GPS receivers record."""

from __future__ import annotations

from pathlib import Path
from xml.etree import ElementTree

from rover_mission.mission_file import Mission, Waypoint


def load_gpx(path: Path) -> Mission:
    """Read the track points of a GPX file."""
    waypoints = []
    for number, point in enumerate(ElementTree.parse(path).iter("trkpt")):
        waypoints.append(Waypoint(str(number), float(point.get("lon")), float(point.get("lat"))))
    return Mission("map", tuple(waypoints))


def thinned(mission: Mission, closest_m: float) -> Mission:
    """Return the mission without waypoints that are closer than that to the one before."""
    kept = list(mission.waypoints[:1])
    for waypoint in mission.waypoints[1:]:
        if kept[-1].distance_to(waypoint) >= closest_m:
            kept.append(waypoint)
    return Mission(mission.frame, tuple(kept), mission.loop)
