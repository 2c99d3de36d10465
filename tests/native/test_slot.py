"""What the library writes is, byte for byte, what the hook in Python writes."""

import struct

from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from roslens.live.inside import slots
from roslens.live.inside.sequence import Sequence
from roslens.live.inside.slots import PUBLISHED, TAKEN, Slot

START = 1_700_000_000_000_000_000
GID = bytes(range(1, 17))
OWN = b"\xab" * 16


def expected(kind, gid, topic, node):
    slot = Slot(memoryview(bytearray(slots.SLOT_BYTES)))
    slot.begin(kind, gid, topic, node, "")
    return slot


def raw(slot):
    return bytes(slot._numbers.cast("B"))


def test_header(either):
    node = either()
    node.say(f"time {START}", "publisher /scan / laser")
    header = slots.HEADER.unpack_from(node.file())
    assert header[:5] == (slots.MAGIC, slots.VERSION, slots.SLOT_BYTES, slots.CAPACITY, 0)
    assert header[5:9] == (node.process.pid, START, 0, 0)
    assert len(node.file()) == slots.HEADER_BYTES + slots.CAPACITY * slots.SLOT_BYTES
    assert node.state() == "preload: counting rmw_fake"


def test_published(either):
    node = either()
    node.say("publisher /scan /robot laser", "set size 100")
    slot = expected(PUBLISHED, OWN, "/scan", "/robot/laser")
    for step in range(5):
        now = START + step * 300_000_000
        node.say(f"time {now}", f"publish 0 {'serialized' if step % 2 else 'typed'}")
        slot.published(now, 100 if step % 2 else -1)
    assert node.slots() == [raw(slot)]


def test_taken(either):
    node = either()
    node.say("subscription /scan / map", "set size 64")
    slot, sequence = expected(TAKEN, GID, "/scan", "/map"), Sequence()
    for step, number in enumerate([7, 8, 10, 9, 14, 15]):
        received = START + step * 40_000_001
        sent, now = received - 1_234_567 * step, received + 50_000
        how = "serialized_info" if step % 3 == 0 else "info"
        assert node.say(f"time {now}", f"message {sent} {received} {number} {GID.hex()}", f"take 0 {how}")[-1] == 1
        sequence.feed(number, now)
        slot.arrived(now, received, received - sent, None, 64 if step % 3 == 0 else -1, sequence)
    assert node.slots() == [raw(slot)]
    assert (sequence.lost, sequence.pending) == (0, 3)


def test_names_as_long_as_they_get(either):
    topic = "/" + "t" * 600
    node = either()
    node.say(f"publisher {topic} /robot {'n' * 400}", f"time {START}", "publish 0 typed")
    slot = expected(PUBLISHED, OWN, topic, "/robot/" + "n" * 400)
    slot.published(START, -1)
    assert node.slots() == [raw(slot)]


steps = st.tuples(
    st.sampled_from([0, 1, 20_000_000, 300_000_000, 1_100_000_000]),  # until the next message
    st.sampled_from([-3, -2, -1, 0, 1, 1, 1, 1, 2, 5]),  # its number after the one before
    st.integers(-5_000_000, 60_000_000),  # its latency
)


def test_any_series(node):
    of = node()
    of.say(f"time {START}")
    clock, count = START, 0

    @settings(max_examples=60, deadline=None, suppress_health_check=list(HealthCheck))
    @given(st.lists(steps, max_size=60))
    def holds(series):
        nonlocal clock, count
        count += 1
        slot, sequence, number = expected(TAKEN, GID, f"/t{count}", "/n"), Sequence(), 100
        (handle,) = of.say(f"subscription /t{count} / n")
        lines = []
        for pause, jump, latency in series:
            clock += pause
            number = max(1, number + jump)
            lines += [f"time {clock}", f"message {clock - latency} {clock} {number} {GID.hex()}", f"take {handle} info"]
            sequence.feed(number, clock)
            slot.arrived(clock, clock, latency, None, -1, sequence)
        if lines:
            of.say(*lines)
            assert of.slots()[-1] == raw(slot)

    holds()


def test_layout_has_no_room_between_fields():
    assert struct.calcsize("=8sIIIIQqQQ64s128s") == slots.HEADER.size == 248
