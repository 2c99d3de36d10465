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

"""Reports of missions."""

from rover_mission.report import Report


def test_times_count_from_the_start() -> None:
    report = Report(["gate", "oak", "home"])
    report.start(100.0)
    assert report.reached(1, 112.5)
    assert not report.reached(1, 113.0)
    report.finish(130.0, 2, "no way on")
    assert report.as_csv() == "waypoint,seconds,reason\ngate,12.5,\noak,30.0,\nhome,,\nend,30.0,no way on\n"
