import math
import os
import random
import subprocess
import sys
import threading
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from roslens.live.inside import slots
from roslens.live.inside.counter_file import CounterFile
from roslens.live.inside.counters import CounterReader, joined
from roslens.live.inside.sequence import SETTLE_NS, Sequence
from roslens.live.inside.snapshot import difference, snapshot
from roslens.model.traffic.tally import Observer

GID = bytes(range(16))
SECOND = 1_000_000_000


def new_slot(kind=slots.TAKEN):
    words = memoryview(bytearray(slots.SLOT_BYTES))
    slot = slots.Slot(words)
    slot.begin(kind, GID, "/scan", "/listener", "")
    return words, slot


def take(slot, when, latency=None, **more):
    slot.arrived(when, when, latency, more.get("age"), more.get("size", -1), more.get("sequence"))


def test_a_difference_is_what_came_between_two_reads():
    words, slot = new_slot()
    for index in range(3):
        take(slot, SECOND + index * 10_000_000, 1000, size=10)
    before = snapshot(words)
    for index in range(3, 8):
        take(slot, SECOND + index * 10_000_000, 2000, size=10)
    tally = difference(before, snapshot(words), 1.0, 2.0)
    assert (tally.topic, tally.publisher, tally.subscriber) == ("/scan", "", "/listener")
    assert (tally.count, tally.bytes, tally.observer) == (5, 50, Observer.INSIDE)
    assert tally.period.count == 5
    assert tally.period.mean == pytest.approx(0.01)
    assert tally.latency.mean == pytest.approx(2e-6)
    assert tally.first == pytest.approx(1.03)
    assert tally.last == pytest.approx(1.07)


def test_an_extreme_is_told_once():
    words, slot = new_slot()
    take(slot, SECOND)
    take(slot, SECOND + 500_000)
    take(slot, SECOND + 100_500_000)  # a gap of 0.1 s, in the same bank as what follows
    first = snapshot(words)
    take(slot, SECOND + 101_000_000)
    take(slot, SECOND + 102_000_000)
    second = snapshot(words)
    assert difference(None, first, 0, 1).period.greatest == pytest.approx(0.1)
    assert difference(first, second, 1, 2).period.greatest < 0.002


@given(st.lists(st.lists(st.integers(1, 3 * SECOND // 10), min_size=1, max_size=12), min_size=1, max_size=8))
def test_reads_together_tell_the_whole(reads):
    """Counts and sums add up; the extremes of all reads are those of the series."""
    words, slot = new_slot()
    when, before, tallies, gaps = SECOND, None, [], []
    take(slot, when)
    for read in reads:
        for gap in read:
            when += gap
            gaps.append(gap * 1e-9)
            take(slot, when, gap)
        after = snapshot(words)
        tallies.append(difference(before, after, 0, when * 1e-9))
        before = after
    whole = tallies[0].period
    for tally in tallies[1:]:
        assert tally.period.least <= tally.period.mean * 1.000001
        assert tally.period.greatest >= tally.period.mean * 0.999999
        whole = whole.merged(tally.period)
    assert whole.count == len(gaps)
    assert math.isclose(whole.total, sum(gaps), rel_tol=1e-6)
    assert math.isclose(whole.least, min(gaps), rel_tol=1e-6)
    assert math.isclose(whole.greatest, max(gaps), rel_tol=1e-6)


def plain(values):
    return (len(values), pytest.approx(sum(values)), pytest.approx(sum(value * value for value in values)))


@given(
    st.lists(
        st.tuples(
            st.integers(1, SECOND), st.none() | st.integers(-5, 10**7), st.none() | st.integers(0, 10**9),
            st.integers(-1, 500), st.booleans(),
        ),
        min_size=1, max_size=40,
    )
)  # fmt: skip
def test_every_number_of_a_slot_is_that_of_counting_plainly(messages):
    words, slot = new_slot()
    sequence = Sequence()
    when, number = SECOND, 0
    for gap, latency, age, size, missing in messages:
        when += gap
        number += 1 + missing
        sequence.feed(number, when)
        take(slot, when, latency, age=age, size=size, sequence=sequence)
    now = snapshot(words)
    gaps = [gap * 1e-9 for gap, *_ in messages[1:]]
    latencies = [latency * 1e-9 for _, latency, *_ in messages if latency is not None]
    ages = [age * 1e-9 for _, _, age, *_ in messages if age is not None]
    sizes = [size for *_, size, _ in messages if size >= 0]
    assert now.moments == (*plain(gaps), *plain(latencies), *plain(ages), 0, 0.0, 0.0)
    assert (now.messages, now.size) == (len(messages), sum(sizes) if sizes else -1)
    assert (now.first, now.last) == (SECOND + messages[0][0], when)
    assert (now.lost + now.pending, now.pending_since) == (
        sum(missing for *_, missing in messages[1:]), sequence.pending_since
    )  # fmt: skip


@given(st.lists(st.tuples(st.integers(1, SECOND), st.integers(0, 10**9)), min_size=1, max_size=40))
def test_processing_times_are_those_of_counting_plainly(answers):
    words, slot = new_slot(slots.ANSWERED)
    when = SECOND
    for gap, processing in answers:
        when += gap
        slot.answered(when, processing)
    now = snapshot(words)
    assert now.moments[:9] == (0, 0.0, 0.0) * 3
    assert now.moments[9:] == plain([processing * 1e-9 for _, processing in answers])
    assert (now.messages, now.size, now.first, now.last, now.lost) == (len(answers), -1, 0, when, -1)
    recent = [processing * 1e-9 for _, processing in answers[-8:]]
    tally = difference(None, now, 0, when * 1e-9)
    assert tally.processing.least <= min(recent) * 1.000001
    assert tally.processing.greatest >= max(recent) * 0.999999


def test_losses_are_told_when_they_have_settled_and_once():
    words, slot = new_slot()
    sequence = Sequence()
    for number, when in ((1, SECOND), (5, 2 * SECOND)):
        sequence.feed(number, when)
        take(slot, when, sequence=sequence)
    after = snapshot(words)
    assert difference(None, after, 0, 2.1).lost == 0
    settled = 2.1 + SETTLE_NS * 1e-9
    assert difference(after, after, 2.1, settled).lost == 3
    assert difference(after, after, settled, settled + 1, lost=3).lost == 0


def test_a_clock_set_back_yields_no_period():
    words, slot = new_slot()
    for when in (5 * SECOND, 4 * SECOND, 4 * SECOND + 1000):
        take(slot, when)
    tally = difference(None, snapshot(words), 0, 5)
    assert (tally.count, tally.period.count) == (3, 1)
    assert tally.period.least == pytest.approx(1e-6)


def test_a_slot_that_is_being_written_is_not_read():
    words, slot = new_slot()
    take(slot, SECOND)
    words.cast("q")[slots.SEQUENCE] |= 1
    assert snapshot(words) is None
    take(slot, SECOND + 5)  # whoever was interrupted in the middle writes the whole anew
    assert snapshot(words).messages == 2


def test_a_reader_never_sees_half_a_message():
    words, slot = new_slot(slots.PUBLISHED)
    done = threading.Event()

    def write():
        for index in range(1, 30_000):
            slot.published(index * 1000, 7)
        done.set()

    writer = threading.Thread(target=write)
    writer.start()
    seen = 0
    while not done.is_set():
        now = snapshot(words)
        if now is None or not now.messages:
            continue
        seen += 1
        assert now.size == now.messages * 7
        assert now.last == now.messages * 1000
        assert now.moments[0] == now.messages - 1
    writer.join()
    assert seen


def test_a_file_is_read_while_its_process_lives_and_once_after(tmp_path):
    folder = tmp_path / "counters"
    reader = CounterReader(str(folder))
    assert reader.read(1.0) == []
    file = CounterFile(str(folder))
    assert folder.stat().st_mode & 0o077 == 0
    slot = file.slot(slots.TAKEN, GID, "/scan", "/listener")
    take(slot, SECOND)
    (one,) = reader.read(2.0)
    assert (one.pid, one.gid, one.tally.count) == (os.getpid(), GID.hex(), 1)
    take(slot, 2 * SECOND)
    file.close()
    (last,) = reader.read(3.0)
    assert last.tally.count == 1
    assert reader.read(4.0) == []
    assert list(folder.iterdir()) == []


def test_what_was_counted_before_the_first_read_is_not_told(tmp_path):
    file = CounterFile(str(tmp_path))
    slot = file.slot(slots.PUBLISHED, b"", "/scan", "/lidar")
    slot.published(SECOND, -1)
    reader = CounterReader(str(tmp_path))
    assert reader.read(2.0) == []
    slot.published(2 * SECOND, -1)
    assert [one.tally.count for one in reader.read(3.0)] == [1]
    reader.close()
    file.close()


def test_a_killed_process_leaves_a_file_that_is_read_and_removed(tmp_path):
    code = (
        "import sys; from roslens.live.inside import counter_file, slots; "
        "f = counter_file.CounterFile(sys.argv[1]); f.slot(slots.PUBLISHED, b'', '/t', '/n').published(5, 3); "
        "print('ready', flush=True); sys.stdin.read()"
    )
    reader = CounterReader(str(tmp_path))
    reader.read(1.0)
    with subprocess.Popen(
        [sys.executable, "-c", code, str(tmp_path)], stdin=subprocess.PIPE, stdout=subprocess.PIPE
    ) as process:
        process.stdout.readline()
        process.kill()
    assert [one.tally.bytes for one in reader.read(2.0)] == [3]
    assert list(tmp_path.iterdir()) == []


def test_foreign_files_are_failures_told_once(tmp_path):
    seed = random.Random(5)
    (tmp_path / "short.counters").write_bytes(b"RLCOUNTS")
    (tmp_path / "empty.counters").write_bytes(b"")
    (tmp_path / "noise.counters").write_bytes(seed.randbytes(10_000))
    reader = CounterReader(str(tmp_path))
    assert reader.read(1.0) == []
    failures = [str(failure) for failure in reader.failures()]
    assert len(failures) == 3
    assert any("8 bytes, expected at least 4096" in text for text in failures)
    reader.read(2.0)
    assert reader.failures() == []


def test_a_hook_that_does_not_count_is_a_failure(tmp_path):
    file = CounterFile(str(tmp_path))
    file.say("rclpy: not counting: Executor._take_subscription is not there")
    reader = CounterReader(str(tmp_path))
    reader.read(1.0)
    (failure,) = reader.failures()
    assert "Executor._take_subscription is not there" in failure.what
    reader.close()
    file.close()


def test_a_full_file_gives_the_slot_of_who_has_long_been_silent(tmp_path):
    file = CounterFile(str(tmp_path), capacity=2)
    old = file.slot(slots.PUBLISHED, b"", "/old", "/n")
    young = file.slot(slots.PUBLISHED, b"", "/young", "/n")
    old.published(SECOND, -1)
    young.published(90 * SECOND, -1)
    reader = CounterReader(str(tmp_path))
    reader.read(1.0)
    assert file.slot(slots.PUBLISHED, b"", "/none", "/n", now=10 * SECOND) is None
    new = file.slot(slots.PUBLISHED, b"", "/new", "/n", now=100 * SECOND)
    new.published(100 * SECOND, -1)
    old.published(101 * SECOND, -1)
    counts = {one.tally.topic: one.tally.count for one in reader.read(2.0)}
    assert counts == {"/new": 1, "/young": 0}
    assert "1 endpoints found no slot" in reader.failures()[0].what
    reader.close()
    file.close()


def test_publishers_get_their_names_and_outputs_their_processing(tmp_path):
    reader = CounterReader(str(tmp_path))
    reader.read(0.5)
    file = CounterFile(str(tmp_path))
    take(file.slot(slots.TAKEN, GID, "/in", "/relay"), SECOND, 1000)
    take(file.slot(slots.TAKEN, b"gone" * 4, "/in", "/relay"), SECOND)
    file.slot(slots.PUBLISHED, b"", "/out", "/relay").published(SECOND, 9)
    file.slot(slots.ANSWERED, b"", "/out", "/relay", "/in").answered(SECOND, 40_000)
    tallies = joined(reader.read(2.0), {GID.hex(): "/lidar"}.get, "robot")
    assert [(t.topic, t.publisher, t.subscriber, t.count) for t in tallies] == [
        ("/in", "", "/relay", 1),
        ("/in", "/lidar", "/relay", 1),
        ("/out", "/relay", "", 1),
    ]
    assert tallies[2].processing.mean == pytest.approx(40e-6)
    assert tallies[2].bytes == 9
    assert {t.host for t in tallies} == {"robot"}
    # A publisher that is gone and says nothing more is no connection.
    assert len(joined(reader.read(3.0), {GID.hex(): "/lidar"}.get, "robot")) == 2
    reader.close()
    file.close()


def test_hostile_names_fit(tmp_path):
    words, slot = new_slot()
    slot.begin(slots.TAKEN, b"x" * 99, "/" + "ü" * 10_000, "/-:[::1]\ud800", "")
    now = snapshot(words)
    assert now.topic.startswith("/üü")
    assert len(now.topic.encode()) <= slots.NAME_BYTES + 2
    assert now.node == "/-:[::1]?"


def test_a_folder_of_somebody_else_is_refused(tmp_path):
    target = tmp_path / "target"
    target.mkdir()
    (tmp_path / "link").symlink_to(target)
    with pytest.raises(PermissionError, match="is not a folder"):
        CounterFile(str(tmp_path / "link"))
    assert list(target.iterdir()) == []
    assert slots.folder_of({}, 7) == str(Path("/dev/shm") / "roslens-7")
    assert slots.folder_of({slots.VARIABLE: "/x"}) == "/x"
