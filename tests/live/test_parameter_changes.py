from hypothesis import given
from hypothesis import strategies as st

from roslens.live.reported.parameter_changes import MOST_EVENTS, parameter_events
from roslens.model.graph import Change, Event


def test_what_was_set_changed_and_deleted():
    before = {"/a/same": "1", "/a/rate": "10", "/a/old": "x"}
    assert parameter_events(before, {"/a/same": "1", "/a/rate": "20", "/a/new": "y"}, 5.0) == [
        Event(5.0, Change.APPEARED, "parameter:/a/new", "is y"),
        Event(5.0, Change.VANISHED, "parameter:/a/old", "was x"),
        Event(5.0, Change.CHANGED, "parameter:/a/rate", "10 is now 20"),
    ]


def test_thousands_at_once_are_a_number():
    events = parameter_events({}, {f"/p{number}": "1" for number in range(2000)}, 0.0)
    assert len(events) == MOST_EVENTS + 1
    assert "1,900 more" in events[-1].detail


@given(st.dictionaries(st.text(), st.text()))
def test_nothing_happens_between_the_same(values):
    assert parameter_events(values, dict(values), 0.0) == []
