"""Names break between their parts, never inside a word for which there is room."""

from __future__ import annotations

import pytest

from roslens.dashboard.tables.breakable import breakable


@pytest.mark.parametrize(
    ("text", "parts"),
    [
        ("src/rover/launch/rover.launch.py:42", ["src/", "rover/", "launch/", "rover.launch.py:42"]),
        ("/robot1/amcl", ["/robot1/", "amcl"]),
        ("nav2_amcl::AmclNode", ["nav2_", "amcl::", "AmclNode"]),
        (
            "nav2_bringup/launch/unique_multi_tb3_simulation_launch.py",
            ["nav2_bringup/", "launch/", "unique_", "multi_", "tb3_", "simulation_", "launch.py"],
        ),
        ("a<b>/c&d", ["a&lt;b&gt;/", "c&amp;d"]),
        ("", [""]),
    ],
)
def test_a_name_breaks_between_its_parts(text, parts):
    assert breakable(text).split("<wbr>") == parts
