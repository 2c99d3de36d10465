"""What is the same in every system is left out by name, and only that."""

from __future__ import annotations

import pytest

from roslens.dashboard.computation.noise import DEFAULT, kinds_of_noise, matches, presets_of


@pytest.mark.parametrize(
    ("name", "kinds"),
    [
        ("/rosout", ("rosout",)),
        ("/robot/rosout_agg", ("rosout",)),
        ("/parameter_events", ("events",)),
        ("/planner/set_parameters", ("parameters",)),
        ("/planner/change_state", ("lifecycle",)),
        ("/planner/transition_event", ("lifecycle",)),
        ("/tf_static", ("tf",)),
        ("/planner/debug/costs", ("debug",)),
        ("/scan", ()),
        ("/tfoo", ()),
        ("/get_parameters_of_motor", ()),
    ],
)
def test_kinds_of_noise(name: str, kinds: tuple[str, ...]) -> None:
    assert kinds_of_noise(name) == kinds


def test_a_pattern_without_a_wildcard_means_what_lies_below_too() -> None:
    assert matches("/rviz", ("/rviz",))
    assert matches("/rviz/clicked_point", ("/rviz/",))
    assert not matches("/rviz2", ("/rviz",))
    assert matches("/left/camera_info", ("/left/*_info",))
    assert not matches("/left/camera", ("/left/*_info",))


def test_an_address_names_presets() -> None:
    assert presets_of("") == DEFAULT == {"implicit", "rosout", "events", "parameters", "lifecycle"}
    assert presets_of("none") == frozenset()
    assert presets_of("tf,nonsense") == {"tf"}
