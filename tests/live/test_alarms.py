import pytest

from roslens.live.replay.alarms import AlarmLog
from roslens.live.replay.expected_alarms import ExpectedAlarm, ExpectedAlarms, Others, compare, read_expected
from roslens.model.entity import EntityId, EntityKind
from roslens.model.errors import DocumentError
from roslens.model.verdict import State, Verdict


def verdict(time, state, since=None, topic="/scan", quantity="rate"):
    return Verdict(
        EntityId(EntityKind.TOPIC, topic), f"rover.{quantity}", quantity, state, time if since is None else since, time
    )


def log_of(*verdicts):
    log = AlarmLog()
    for one in verdicts:
        log.add([one])
    return log.alarms()


def test_from_bad_to_fine_is_one_alarm_the_worst_state_counts():
    alarms = log_of(
        verdict(1, State.OK),
        verdict(10, State.LOW, since=9.5),
        verdict(12, State.ABSENT, since=9.5),
        verdict(20, State.OK, since=19.5),
        verdict(30, State.HIGH, since=29.0),
    )
    assert [(one.since, one.reported, one.until, one.worst.state) for one in alarms] == [
        (9.5, 10, 19.5, State.ABSENT),
        (29.0, 30, float("inf"), State.HIGH),
    ]


def test_what_is_unknown_ends_an_alarm_and_is_none():
    alarms = log_of(verdict(1, State.LOW), verdict(2, State.UNKNOWN), verdict(3, State.SUSPENDED))
    assert [(one.since, one.until) for one in alarms] == [(1, 2)]


def test_sentences_and_entities_are_apart():
    alarms = log_of(
        verdict(1, State.LOW), verdict(2, State.LOW, topic="/odom"), verdict(3, State.HIGH, quantity="jitter")
    )
    assert len(alarms) == 3


ALARMS = log_of(verdict(110, State.LOW, since=109.0), verdict(130, State.ABSENT, topic="/odom"))


def expected(**given):
    return ExpectedAlarm(**{"entity": "topic:/scan", "at": 9.0, "within": 0.5, "line": 1, **given})


@pytest.mark.parametrize(
    ("one", "fits"),
    [
        (expected(), True),
        (expected(at=9.5), True),
        (expected(at=9.6), False),
        (expected(state=State.LOW), True),
        (expected(state=State.HIGH), False),
        (expected(quantity="rate"), True),
        (expected(quantity="jitter"), False),
        (expected(entity="topic:/odom"), False),
    ],
)
def test_what_fits(one, fits):
    assert compare(ALARMS, ExpectedAlarms((one,), Others.ALLOWED), 100.0).passed is fits


def test_an_alarm_fits_one_line_only_and_others_are_surplus():
    outcome = compare(ALARMS, ExpectedAlarms((expected(), expected(line=2))), 100.0)
    assert [one.line for one in outcome.missing] == [2]
    assert [str(one.first.entity) for one in outcome.surplus] == ["topic:/odom"]


def test_a_document_is_read(tmp_path):
    path = tmp_path / "alarms.yaml"
    path.write_text(
        "kind: reference test\nothers: allowed\nalarms:\n"
        "  - entity: topic:/scan\n    at: 500 ms\n    state: low\n  - entity: node:/a\n    at: 2\n    within: 2 s\n"
    )
    assert read_expected(path) == ExpectedAlarms(
        (
            ExpectedAlarm("topic:/scan", 0.5, 0.5, 4, state=State.LOW),
            ExpectedAlarm("node:/a", 2.0, 2.0, 7),
        ),
        Others.ALLOWED,
    )


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("kind: reference\nalarms: []", "kind is 'reference'"),
        ("kind: reference test\nalarms:\n  - entity: topic:/scan", "without 'at'"),
        ("kind: reference test\nalarms:\n  - {entity: scan, at: 1 s}", "entity is 'scan'; expected KIND:NAME"),
        ("kind: reference test\nalarms:\n  - {entity: 'topic:/a', at: 1 Hz}", "at: "),
        ("kind: reference test\nalarms:\n  - {entity: 'topic:/a', at: 1 s, quantity: rat}", "Did you mean 'rate'"),
        ("kind: reference test\nalarms:\n  - {entity: 'topic:/a', at: 1 s, state: ok}", "state is 'ok'"),
        ("kind: reference test\nother: none", "unknown key 'other'"),
    ],
)
def test_wrong_documents(tmp_path, text, said):
    path = tmp_path / "alarms.yaml"
    path.write_text(text)
    with pytest.raises(DocumentError, match=said):
        read_expected(path)
