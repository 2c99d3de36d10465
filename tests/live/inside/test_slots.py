"""A slot serves its endpoint while that is there, and another when all have read what it counted."""

import pytest

from roslens.live.inside.counter_file import CounterFile
from roslens.live.inside.counters import CounterReader
from roslens.live.inside.slots import HEADER, PUBLISHED, REST_NS

START = 1_700_000_000_000_000_000
S = 1_000_000_000


@pytest.fixture
def file(tmp_path):
    made = CounterFile(str(tmp_path), capacity=8)
    yield made
    made.close()


def publisher(file, number, now):
    slot = file.slot(PUBLISHED, b"", f"/t{number}", "/tool", now=now)
    assert slot is not None
    slot.published(now, 10)
    return slot


def test_endpoints_without_number_need_few_slots(file):
    publisher(file, 0, START)
    for number in range(1, 100):
        now = START + number * 2 * S
        file.end([publisher(file, number, now)], now)
    header = HEADER.unpack_from(file.path.read_bytes())
    assert header[4] == 1 + REST_NS // (2 * S)
    assert header[8] == 0


def test_what_ended_is_not_given_to_another_before_it_was_read(file):
    slots = [publisher(file, number, START) for number in range(8)]
    file.end(slots, START)
    assert file.slot(PUBLISHED, b"", "/late", "/tool", now=START + REST_NS - 1) is None
    assert file.slot(PUBLISHED, b"", "/late", "/tool", now=START + REST_NS) is not None


def test_an_endpoint_that_ended_twice_or_lost_its_slot_before_ends_once(file):
    slots = [publisher(file, number, START) for number in range(8)]
    newcomer = publisher(file, 8, START + 61 * S)
    (left,) = [slot for slot in slots if slot.left]
    file.end([left], START + 62 * S)
    newcomer.published(START + 63 * S, 10)
    assert not newcomer.left


def test_a_reader_tells_what_ended_once_and_then_no_more(file, tmp_path):
    reader = CounterReader(str(tmp_path))
    now = START / S
    reader.read(now)
    kept, gone = publisher(file, 0, START + S), publisher(file, 1, START + S)
    file.end([gone], START + S)
    counts = []
    for step in range(2, 8):
        read = {one.tally.topic: one.tally.count for one in reader.read(now + step)}
        counts.append((read.get("/t0"), read.get("/t1")))
    assert counts[0] == (1, 1)
    assert counts[-1] == (0, None)
    assert [tally for _, tally in counts].count(1) == 1
    kept.published(START + 9 * S, 10)
    assert [one.tally.count for one in reader.read(now + 10)] == [1]
    reader.close()
