import msgspec

from roslens.live.publish.diagnostics import ERROR, OK, STALE, WARN, diagnostics, verdict_message
from roslens.live.publish.json_lines import event_line, failure_line, verdict_line
from roslens.model.entity import EntityId, EntityKind
from roslens.model.failure import Failure
from roslens.model.finding import Severity
from roslens.model.graph import Change, Event
from roslens.model.verdict import State, Verdict

SCAN = EntityId(EntityKind.TOPIC, "/scan")
BASE = EntityId(EntityKind.HOST, "base")


def verdict(state=State.OK, entity=SCAN, quantity="rate", value=25.0, **more):
    return Verdict(entity, f"rover.{quantity}", quantity, state, 1.0, 2.0, value, "25..35 Hz", **more)


def test_levels():
    cases = [
        ([verdict()], OK),
        ([verdict(State.LOW)], WARN),
        ([verdict(State.LOW, severity=Severity.ERROR)], ERROR),
        ([verdict(State.ABSENT)], WARN),
        ([verdict(State.UNKNOWN)], STALE),
        ([verdict(State.SUSPENDED)], STALE),
        ([verdict(State.UNKNOWN), verdict(State.OK, quantity="latency")], OK),
        ([verdict(State.OK), verdict(State.HIGH, quantity="latency", severity=Severity.ERROR)], ERROR),
    ]
    for verdicts, level in cases:
        assert [status.level for status in diagnostics(verdicts)] == [level], verdicts


def test_a_status_says_what_is_wrong_and_all_values():
    (status,) = diagnostics(
        [verdict(State.LOW, value=12.34567, text="check the cable"), verdict(quantity="latency", value=0.0123)]
    )
    assert status.name == "roslens: topic /scan"
    assert status.message == "rate is low: 12.35 Hz, expected 25..35 Hz; check the cable"
    assert status.values == (
        ("latency", "12.3 ms"), ("latency state", "ok"), ("rate", "12.35 Hz"), ("rate state", "low"),
    )  # fmt: skip


def test_one_status_an_entity_sorted():
    statuses = diagnostics([verdict(), verdict(entity=BASE, quantity="cpu"), verdict(quantity="latency")])
    assert [status.name for status in statuses] == ["roslens: host base", "roslens: topic /scan"]
    assert [status.hardware_id for status in statuses] == ["base", ""]


def test_the_hardware_is_the_host_where_the_entity_is():
    process = EntityId(EntityKind.PROCESS, "base/42")
    statuses = diagnostics([verdict(entity=process, quantity="cpu")])
    assert [status.hardware_id for status in statuses] == ["base"]
    (status,) = diagnostics([verdict()], lambda entity: f"host of {entity.name}")
    assert status.hardware_id == "host of /scan"


def test_sentences():
    assert verdict_message(verdict(State.ABSENT, quantity="presence", value=None)) == "is expected but not there"
    why = "node /a is not there; its process 7 on robot crashed (SIGKILL)"
    gone = msgspec.structs.replace(verdict(State.ABSENT, quantity="presence", value=None), evidence=why)
    assert verdict_message(gone) == "is expected but not there: its process 7 on robot crashed (SIGKILL)"
    never = msgspec.structs.replace(verdict(State.HIGH, quantity="presence"), range="<= 0")
    assert verdict_message(never) == "is there, expected never"
    assert verdict_message(verdict(State.ABSENT, value=None)) == "is silent, expected 25..35 Hz"
    assert verdict_message(verdict(State.HIGH, cause="host:base")) == (
        "rate is high: 25 Hz, expected 25..35 Hz (because of host:base)"
    )


def test_lines_of_json():
    line = msgspec.json.decode(verdict_line(verdict(State.LOW)))
    assert (line["schema"], line["is"], line["entity"], line["state"]) == (1, "verdict", "topic:/scan", "low")
    line = msgspec.json.decode(event_line(Event(1.0, Change.VANISHED, "node:/a\n")))
    assert (line["is"], line["change"], line["entity"]) == ("event", "vanished", "node:/a\n")
    assert "\n" not in event_line(Event(1.0, Change.VANISHED, "node:/a\n"))
    assert msgspec.json.decode(failure_line(Failure("link", "it hung up")))["what"] == "it hung up"
