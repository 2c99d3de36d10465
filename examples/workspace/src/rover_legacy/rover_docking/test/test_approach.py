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

"""The way onto the station."""

import unittest

from rover_docking.approach import ALIGNING, DOCKED, DRIVING, FAILED, SEARCHING, Approach, Sighting


class ApproachTest(unittest.TestCase):
    """One step at a time."""

    def test_turns_until_it_sees_the_station(self):
        approach = Approach(search_turn=0.3)
        self.assertEqual(approach.step(Sighting(), False, False, 0.1), (0.0, 0.3))
        approach.step(Sighting(0.2, 0.4), False, False, 0.1)
        self.assertEqual(approach.state, ALIGNING)

    def test_drives_once_it_looks_at_the_station(self):
        approach = Approach()
        approach.state = ALIGNING
        approach.step(Sighting(0.01, 0.4), False, False, 0.1)
        self.assertEqual(approach.state, DRIVING)

    def test_searches_again_when_it_lost_the_station(self):
        approach = Approach()
        approach.state = DRIVING
        for _ in range(12):
            approach.step(Sighting(), False, False, 0.1)
        self.assertEqual(approach.state, SEARCHING)

    def test_current_means_docked_and_time_means_failed(self):
        approach = Approach(patience_s=1.0)
        approach.step(Sighting(), True, True, 0.1)
        self.assertEqual(approach.state, DOCKED)
        approach = Approach(patience_s=1.0)
        approach.step(Sighting(), False, False, 1.5)
        self.assertEqual(approach.state, FAILED)


if __name__ == "__main__":
    unittest.main()
