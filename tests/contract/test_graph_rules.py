"""Rules of the computation graph say what a reader of reports needs, and each has a test of its own."""

from pathlib import Path

import pytest

from roslens.plugins.contract import lacking_text
from roslens.source.rules.graph import ConfigurationInput, plugin, with_options
from roslens.source.rules.graph.surroundings import Surroundings
from testbed.configured import RELIABLE, SENSOR, configuration, end, node

TESTS = Path(__file__).parents[1] / "source" / "rules" / "graph"


def test_every_text_is_there():
    assert list(lacking_text(plugin.manifest)) == []


@pytest.mark.parametrize("rule", plugin.manifest.rules, ids=lambda rule: rule.id)
def test_a_rule_is_declared_in_full_and_tested(rule):
    assert rule.id.startswith("graph.")
    assert rule.scope == "configuration"
    assert {"ros", "graph"} <= set(rule.tags)
    assert (TESTS / f"test_{rule.id.removeprefix('graph.')}.py").is_file()


class Noted:
    def __init__(self):
        self.rules = []

    def finding(self, rule, message, **place):
        self.rules.append((rule, place["path"]))


def test_the_hook_reports_what_the_rules_find():
    known = configuration(
        node("/a", end("pub", "/x", given="x", qos=SENSOR)), node("/b", end("sub", "/x", given="x", qos=RELIABLE))
    )
    noted = Noted()
    plugin.analyse_configuration(ConfigurationInput(known), noted)
    assert noted.rules == [("graph.qos", "src/b.cpp")]


def test_options_take_the_place_of_what_is_usual():
    changed = with_options(Surroundings(), {"external": ["/mine"], "fast_hz": 5.0, "other": 1})
    assert (changed.external, changed.fast_hz, changed.command_topics) == (
        ("/mine",), 5.0, Surroundings().command_topics,
    )  # fmt: skip
