"""What reactions decide, each as a time line of what is known and what has to be done then."""

from __future__ import annotations

from pathlib import Path

import pytest
import yaml

from roslens.intake.safe_yaml import load_yaml
from roslens.judge.pages.reactions_page import EXAMPLE, TIME_LINE
from roslens.judge.reading.read_reference import GivenText, load_reference
from roslens.judge.reading.read_time_line import parse_time_lines
from roslens.live.react.simulation import compare, simulate
from roslens.live.window.signals import BY_KEY

LINES = sorted((Path(__file__).parent / "time_lines").glob("*.yaml"))


def rows():
    """Yield the reactions and a time line of each file; its `checks` are `[at, decision, verification]`."""
    for path in LINES:
        document = load_yaml(path.read_bytes())
        reference = {"kind": "reference", "name": "r", **document.pop("reference")}
        checks = document.pop("checks", {})
        document.pop("about")
        for line in parse_time_lines(yaml.dump(document).encode(), path.name):
            yield pytest.param(reference, line, checks.get(line.name), id=f"{path.stem}-{line.name}")


@pytest.mark.parametrize(("reference", "line", "checks"), list(rows()))
def test_what_has_to_be_decided_is(reference, line, checks):
    loaded = load_reference([GivenText("r.yaml", yaml.dump(reference).encode())], BY_KEY)
    simulation = simulate(loaded.reactions, line)
    outcome = compare(simulation.decisions, line.expected)
    assert outcome.passed, outcome
    if checks is not None:
        found = [[f"{one.at_s:g}", one.decision, one.verification.value] for one in simulation.checks]
        assert found == checks


def test_the_example_of_the_page_does_what_its_time_line_says():
    reference = load_reference([GivenText("front.yaml", EXAMPLE.encode())], BY_KEY)
    (line,) = parse_time_lines(TIME_LINE.encode(), "front.test.yaml")
    assert compare(simulate(reference.reactions, line).decisions, line.expected).passed
