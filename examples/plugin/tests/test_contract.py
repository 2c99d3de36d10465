"""The plug-in keeps the contract, and its metric has the value worked out by hand."""

from pathlib import Path

import pytest
from roslens.plugins.contract import assert_plugin, look_at

PLUGIN = "roslens_plugin_waits.plugin"
FIXTURES = Path(__file__).parent / "fixtures"


def test_contract():
    assert_plugin(PLUGIN, FIXTURES)


def test_waiting_adds_up():
    outcome = look_at(PLUGIN, FIXTURES / "fixed_wait" / "triggers.cpp")
    (measurement,) = outcome.measurements
    assert measurement.value == pytest.approx(0.5 + 0.01 + 0.2)
    assert [(finding.line, finding.message) for finding in outcome.findings] == [
        (7, "waits for 0.5 s"),
        (9, "waits for 0.2 s"),
    ]


def test_the_option_moves_the_limit():
    outcome = look_at(PLUGIN, FIXTURES / "fixed_wait" / "triggers.cpp", options={"longest_s": 0.3})
    assert [finding.line for finding in outcome.findings] == [7]
