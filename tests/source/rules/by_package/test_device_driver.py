"""The computer's clock is right in a driver of a device."""

import pytest

from roslens.model.weight.consequence import Certainty
from roslens.source.rules.by_package.device_driver import as_notes_in_drivers
from roslens.source.rules.hit import Hit

MANIFEST = "<package format='3'><name>{}</name><description>{}</description></package>"


@pytest.mark.parametrize(
    ("name", "description", "rule", "is_note"),
    [
        ("sbg_driver", "An IMU.", "node.own_clock", True),
        ("imu", "Driver of an IMU.", "node.own_clock_python", True),
        ("imu", "Filters an IMU.", "node.own_clock", False),
        ("screwdriver", "Turns screws.", "node.own_clock", False),
        ("imu_driver", "An IMU.", "node.sleep_in_callback", False),
    ],
)
def test_its_manifest_says_so(name, description, rule, is_note, package_view, tmp_path):
    (tmp_path / "p").mkdir()
    (tmp_path / "p/package.xml").write_text(MANIFEST.format(name, description))
    (only,) = as_notes_in_drivers({"p/a.cpp": [Hit(rule, "m", 1)]}, package_view(tmp_path))["p/a.cpp"]
    assert (only.certainty is Certainty.HEURISTIC) is is_note
