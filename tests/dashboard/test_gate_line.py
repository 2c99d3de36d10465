"""Whether a run passes, in one line."""

import pytest

from roslens.dashboard.gate_line import gate_line
from roslens.judge.quality.gate import GateResult
from roslens.model.finding import Severity

COUNTS = {Severity.ERROR: 0, Severity.WARNING: 12, Severity.NOTE: 3}


@pytest.mark.parametrize(
    ("fail_on", "answer", "conditions"),
    [
        ("error", "passes", ("0 errors",)),
        ("warning", "fails", ("0 errors, 12 warnings",)),
        ("never", "nothing fails it", ('fail_on is "never" in roslens.toml',)),
    ],
)
def test_by_the_least_severity_that_fails(fail_on, answer, conditions):
    found = gate_line(COUNTS, fail_on)
    assert (found.answer, found.conditions) == (answer, conditions)
    assert found.text.endswith(f": {'; '.join(conditions)}")


def test_it_reads_as_a_sentence():
    one = {Severity.ERROR: 1, Severity.WARNING: 0, Severity.NOTE: 0}
    assert gate_line(one, "error").text == "Fails the gate: 1 error"
    assert gate_line(COUNTS, "error").text == "Passes the gate: 0 errors"


def test_by_conditions_and_what_cannot_be_told_never_passes():
    holds = GateResult("warnings", True, "12 warnings, at most 20")
    unknown = GateResult("new_errors", None, "new errors: not known without --baseline")
    broken = GateResult("notes", False, "3 notes, at most 1")
    assert gate_line(COUNTS, "never", (holds,)).answer == "passes"
    assert gate_line(COUNTS, "never", (holds, unknown)).answer == "cannot be determined"
    assert gate_line(COUNTS, "error", (holds, unknown, broken)).answer == "fails"
    assert gate_line(COUNTS, "error", (holds,)).conditions == ("0 errors", "12 warnings, at most 20")
