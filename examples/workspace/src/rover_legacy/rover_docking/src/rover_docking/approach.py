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

"""How to drive from what the infrared receivers see: a state machine without any ROS in it."""

import math

SEARCHING, ALIGNING, DRIVING, TOUCHING, DOCKED, FAILED = range(6)

NAMES = {
    SEARCHING: "searching",
    ALIGNING: "aligning",
    DRIVING: "driving",
    TOUCHING: "touching",
    DOCKED: "docked",
    FAILED: "failed",
}


class Sighting:
    """Where the station is seen: its bearing in radians (left is positive) and how strong it is (0 to 1)."""

    def __init__(self, bearing=0.0, strength=0.0):
        self.bearing = bearing
        self.strength = strength

    @property
    def seen(self):
        """Whether there is anything to drive by."""
        return self.strength > 0.05


class Approach:
    """Decides speed and turn, ten times a second."""

    def __init__(self, search_turn=0.4, patience_s=60.0):
        self.state = SEARCHING
        self._search_turn = search_turn
        self._patience_s = patience_s
        self._elapsed_s = 0.0
        self._lost_s = 0.0

    def step(self, sighting, charging, bumped, seconds):
        """Return ``(linear, angular)`` to drive with during the next ``seconds``."""
        self._elapsed_s += seconds
        if charging:
            self.state = DOCKED
        elif self._elapsed_s > self._patience_s and self.state not in (DOCKED, FAILED):
            self.state = FAILED
        self._lost_s = 0.0 if sighting.seen else self._lost_s + seconds

        if self.state == SEARCHING:
            return self._search(sighting)
        if self.state == ALIGNING:
            return self._align(sighting)
        if self.state == DRIVING:
            return self._drive(sighting, bumped)
        if self.state == TOUCHING:
            return self._touch(bumped)
        return 0.0, 0.0

    def _search(self, sighting):
        if sighting.seen:
            self.state = ALIGNING
            return 0.0, 0.0
        return 0.0, self._search_turn

    def _align(self, sighting):
        if self._lost_s > 2.0:
            self.state = SEARCHING
        elif abs(sighting.bearing) < math.radians(3.0):
            self.state = DRIVING
        return 0.0, max(-0.5, min(0.5, 1.5 * sighting.bearing))

    def _drive(self, sighting, bumped):
        if bumped:
            self.state = TOUCHING
            return 0.0, 0.0
        if self._lost_s > 1.0:
            self.state = SEARCHING
            return 0.0, 0.0
        # The nearer the station, the stronger it shines: slow down before the contacts.
        return 0.25 * (1.0 - 0.8 * sighting.strength), 1.2 * sighting.bearing

    def _touch(self, bumped):
        # Press gently until current flows.
        return (0.0 if bumped else 0.03), 0.0
