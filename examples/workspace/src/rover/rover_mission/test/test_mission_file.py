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

"""Mission files: what is read and what is refused."""

from pathlib import Path

import pytest

from rover_mission.mission_file import MissionError, load_mission

MEADOW = Path(__file__).parent.parent / "missions" / "meadow.yaml"


def test_the_shipped_mission() -> None:
    mission = load_mission(MEADOW)
    assert [waypoint.name for waypoint in mission.waypoints] == ["gate", "oak", "pond", "hedge", "home"]
    assert mission.waypoints[0].hold_s == 3.0
    assert mission.length_m == pytest.approx(28.03, abs=0.01)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "expected a mapping"),
        ("waypoints: []", "at least one"),
        ("speed: 3", "unknown key 'speed'"),
        ("waypoints: [{name: a}]", "waypoint 1: expected a mapping with 'at"),
        ("waypoints: [{at: [1, far]}]", "'far' is no number"),
        ("waypoints: [{at: [1, 2]}, {at: [900, 0]}]", "waypoint 2: is farther away"),
        ("waypoints: [{at: [1, 2], name: a}, {at: [2, 2], name: a}]", "called 'a'"),
        ("waypoints: [", "cannot be read"),
    ],
)
def test_what_is_refused(tmp_path: Path, text: str, message: str) -> None:
    path = tmp_path / "mission.yaml"
    path.write_text(text)
    with pytest.raises(MissionError, match="mission.yaml") as caught:
        load_mission(path)
    assert message in str(caught.value)
