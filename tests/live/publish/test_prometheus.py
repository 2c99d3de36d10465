import re

from hypothesis import given
from hypothesis import strategies as st

from roslens.live.publish.prometheus import prometheus_text
from roslens.live.system.connection_name import connection_id
from roslens.live.window.signals import SIGNALS
from roslens.model.entity import EntityId, EntityKind
from roslens.model.verdict import State, Verdict
from roslens.store.journals.journal_head import JournalHead

SCAN = connection_id("/scan", "/lidar", "/slam")


def test_readings_and_verdicts():
    text = prometheus_text(
        [
            (EntityId(EntityKind.TOPIC, "/scan"), {"rate": 25.0, "latency": 0.004}),
            (SCAN, {"rate": 24.5}),
            (EntityId(EntityKind.PROCESS, "base/12"), {"cpu": 3.0}),
        ],
        [Verdict(EntityId(EntityKind.TOPIC, "/scan"), "rover.scan", "rate", State.LOW, 1.0, 2.0, cause="node:/lidar")],
        {"records_total": 5},
    )
    assert text == (
        "# HELP roslens_rate_hertz Messages per second over the window: of a topic as they are sent, of a "
        "connection as they are received.\n"
        "# TYPE roslens_rate_hertz gauge\n"
        'roslens_rate_hertz{topic="/scan"} 25.0\n'
        'roslens_rate_hertz{topic="/scan",publisher="/lidar",subscriber="/slam"} 24.5\n'
        "# HELP roslens_latency_seconds Mean time from publishing to receipt.\n"
        "# TYPE roslens_latency_seconds gauge\n"
        'roslens_latency_seconds{topic="/scan"} 0.004\n'
        "# HELP roslens_cpu_percent Share of one core; of a host the share of all cores.\n"
        "# TYPE roslens_cpu_percent gauge\n"
        'roslens_cpu_percent{host="base",pid="12"} 3.0\n'
        "# HELP roslens_state State of a constraint of the reference.\n"
        "# TYPE roslens_state gauge\n"
        'roslens_state{kind="topic",name="/scan",expectation="rover.scan",quantity="rate",severity="warning",'
        'state="low",cause="node:/lidar"} 1\n'
        "# TYPE roslens_records_total gauge\n"
        "roslens_records_total 5.0\n"
    )


def test_every_signal_has_a_name_of_its_own():
    entity = EntityId(EntityKind.TOPIC, "/x")
    text = prometheus_text([(entity, {signal.key: 1.0 for signal in SIGNALS})], [])
    names = re.findall(r"^# TYPE (\S+) gauge$", text, re.MULTILINE)
    assert len(names) == len(set(names)) == len(SIGNALS)
    assert all(re.fullmatch(r"roslens_[a-z_]+", name) for name in names)


@given(st.text(min_size=1))
def test_hostile_names_stay_on_their_line(name):
    text = prometheus_text([(EntityId(EntityKind.TOPIC, name), {"rate": 1.0})], [])
    lines = text.split("\n")
    assert len(lines) == 4
    assert re.fullmatch(r'roslens_rate_hertz\{topic="(?:[^"\\\n]|\\[\\"n])*"\} 1\.0', lines[2])


def test_what_is_unknown_has_no_line():
    assert prometheus_text([(EntityId(EntityKind.TOPIC, "/x"), {})], []) == "\n"
    assert "roslens_state" not in prometheus_text([], [])


def test_where_journals_end():
    heads = [JournalHead('/a "b"', 12, "3f09"), JournalHead("/gone", 0, "", "it is not there")]
    text = prometheus_text([], [], journals=heads)
    assert [line for line in text.splitlines() if not line.startswith("#")] == [
        'roslens_journal_entries{journal="/a \\"b\\""} 12',
        'roslens_journal_entries{journal="/gone"} 0',
        'roslens_journal_whole{journal="/a \\"b\\""} 1',
        'roslens_journal_whole{journal="/gone"} 0',
        'roslens_journal_head{journal="/a \\"b\\"",hash="3f09"} 1',
    ]
