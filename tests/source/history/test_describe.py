import shlex
from pathlib import Path

import pytest

from roslens.model.entity import EntityKind
from roslens.source.history.describe import process_page
from roslens.source.history.metrics.table import PROCESS_METRICS, PROCESS_QUANTITIES
from roslens.source.metrics.table import QUANTITIES

PAGE = Path(__file__).parents[3] / "docs" / "reference" / "metrics" / "process.md"


def test_the_page_in_the_documentation_is_fresh():
    assert PAGE.read_text("utf-8") == process_page(PROCESS_METRICS), "write it anew: make docs"


def test_no_key_is_taken_twice():
    assert not PROCESS_QUANTITIES.keys() & QUANTITIES.keys()
    assert len(PROCESS_QUANTITIES) == len(PROCESS_METRICS)


@pytest.mark.parametrize("metric", PROCESS_METRICS, ids=lambda metric: metric.QUANTITY.key)
def test_every_metric_names_the_command_of_git(metric):
    whole = EntityKind.REPOSITORY in metric.QUANTITY.kinds
    told_elsewhere = metric.QUANTITY.key == "time_since_last_commit"
    assert ("repository" in metric.COMMANDS) == (whole and not told_elsewhere)
    assert ("path" in metric.COMMANDS) == (EntityKind.PACKAGE in metric.QUANTITY.kinds)
    assert ("file" in metric.COMMANDS) == (EntityKind.FILE in metric.QUANTITY.kinds)
    for command in metric.COMMANDS.values():
        assert "\n" not in command
        assert metric.QUANTITY.key == "hotspot" or "git" in shlex.split(command.replace("<(", " ").replace("(", " "))
    assert all((metric.QUANTITY.text, metric.QUANTITY.formula, metric.QUANTITY.source, metric.QUANTITY.limits))
