"""The conditions of a gate: each holds, is broken, or cannot be determined; never the last as one of the others."""

import re

import pytest

from roslens.judge.quality.gate import GateConditions, GateFacts, Lines, evaluate

FACTS = GateFacts({"errors": 2}, Lines(200, 30), {"errors": 0, "warnings": 3}, Lines(50, 20))


@pytest.mark.parametrize(
    ("conditions", "facts", "holds", "text"),
    [
        (GateConditions(errors=1), FACTS, False, "2 errors, at most 1"),
        (GateConditions(errors=2), FACTS, True, "2 errors, at most 2"),
        (GateConditions(errors=0), GateFacts({"errors": 1}, Lines()), False, "1 error, at most 0"),
        (GateConditions(new_notes=0), GateFacts({}, Lines(), {"notes": 1}), False, "1 new note, at most 0"),
        (GateConditions(warnings=0), FACTS, True, "0 warnings, at most 0"),
        (GateConditions(new_errors=0), FACTS, True, "0 new errors, at most 0"),
        (GateConditions(new_warnings=2), FACTS, False, "3 new warnings, at most 2"),
        (GateConditions(comment_ratio=20), FACTS, False, "comment ratio 15 %, at least 20 %"),
        (GateConditions(comment_ratio_of_new_code=20), FACTS, True, "comment ratio of new code 40 %, at least 20 %"),
        (GateConditions(new_errors=0), GateFacts({}, Lines()), None, "new errors: not known without --baseline"),
        (GateConditions(comment_ratio_of_new_code=1), GateFacts({}, Lines()), None, "not known without --baseline"),
        (GateConditions(new_breaking_interfaces=0), GateFacts({}, Lines()), None, "not known without --baseline"),
        (
            GateConditions(new_breaking_interfaces=0),
            GateFacts({}, Lines(), breaking_interfaces=("a/msg/B",)),
            False,
            "1 new breaking interface, at most 0: a/msg/B",
        ),
        (GateConditions(new_breaking_interfaces=0), GateFacts({}, Lines(), breaking_interfaces=()), True, "at most 0"),
        (GateConditions(comment_ratio=1), GateFacts({}, Lines()), True, "there is no such code"),
    ],
)
def test_a_condition(conditions, facts, holds, text):
    (one,) = evaluate(conditions, facts)
    assert one.holds is holds
    assert text in one.text
    assert not re.search(r"\b1 (new )?\w+s\b", one.text)


def test_all_that_are_asked_for_in_their_order():
    found = evaluate(GateConditions(comment_ratio=1, new_notes=9, notes=1), FACTS)
    assert [one.condition for one in found] == ["notes", "new_notes", "comment_ratio"]
    assert list(evaluate(GateConditions(), FACTS)) == []
