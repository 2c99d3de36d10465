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

"""The charge of the battery by its voltage."""

import pytest

from rover_sensors.battery_curve import TABLE, charge_of


def test_ends() -> None:
    assert charge_of(0.0) == 0.0
    assert charge_of(20.0) == 1.0


def test_rises() -> None:
    charges = [charge_of(12.0 + step * 0.05) for step in range(97)]
    assert charges == sorted(charges)


@pytest.mark.parametrize(("volts", "charge"), TABLE)
def test_meets_its_table(volts: float, charge: float) -> None:
    assert charge_of(volts) == pytest.approx(charge)
