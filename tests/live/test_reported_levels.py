from hypothesis import given
from hypothesis import strategies as st

from roslens.live.publish.diagnostics import diagnostics
from roslens.live.reported.reported_levels import FLAP_S, FLAPS, MOST, SAID, Report, ReportedLevels
from roslens.model.entity import EntityId, EntityKind
from roslens.model.finding import Severity
from roslens.model.graph import Change, Event
from roslens.model.verdict import State, Verdict

OK, WARN, ERROR, STALE = (Report("motor", level, "text", "arm") for level in range(4))


def test_a_level_is_told_when_it_changes_and_not_each_second():
    levels = ReportedLevels()
    told = [levels.take("/a", [report], time) for time, report in enumerate([OK, WARN, WARN, WARN, ERROR, STALE, OK])]
    assert [len(events) for events in told] == [0, 1, 0, 0, 1, 1, 1]
    assert told[1] == [Event(1, Change.CHANGED, "node:/a", f"{SAID}'motor' of arm is WARN, was OK: text")]
    assert told[6][0].detail.startswith(f"{SAID}'motor' of arm is OK, was STALE")


def test_the_same_name_of_two_reporters_is_two_statuses():
    levels = ReportedLevels()
    assert levels.take("/a", [ERROR], 0)
    (event,) = levels.take("", [ERROR], 0)
    assert event.entity == "topic:/diagnostics"
    assert not levels.take("/a", [ERROR], 1)


def test_what_flaps_is_told_once_and_again_when_it_rests():
    levels = ReportedLevels()
    events = [event for time in range(31) for event in levels.take("/a", [(OK, ERROR)[time % 2 == 0]], time)]
    assert [event.change for event in events] == [Change.CHANGED] * FLAPS + [Change.FLAPPING]
    assert not levels.take("/a", [ERROR], 31)
    (rest,) = levels.take("/a", [ERROR], 31 + FLAP_S)
    assert "is ERROR, was OK" in rest.detail
    assert len(levels.take("/a", [OK], 32 + FLAP_S)) == 1


def test_our_own_are_not_told_back():
    entity = EntityId(EntityKind.TOPIC, "/scan")
    verdict = Verdict(entity, "x", "rate", State.LOW, since=0.0, time=0.0, severity=Severity.ERROR)
    own = [Report(status.name, status.level, status.message) for status in diagnostics([verdict])]
    assert own[0].level == 2
    assert ReportedLevels().take("/a", own, 0.0) == []


def test_endless_names_end():
    levels = ReportedLevels()
    events = levels.take("/a", [Report(f"s{number}", 2) for number in range(MOST + 5)], 0)
    assert len(events) == MOST
    assert len(levels.take("/a", [Report("s1", 0)], 1)) == 1


@given(st.lists(st.tuples(st.integers(0, 255), st.text(), st.text())))
def test_any_report_is_told_in_one_line(reports):
    for event in ReportedLevels().take("/a", [Report(name, level, text) for level, name, text in reports], 0.0):
        assert event.detail.isprintable()
