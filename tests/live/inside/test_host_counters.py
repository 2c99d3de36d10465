import os
import time

import pytest

from roslens.live.inside import slots
from roslens.live.inside.counter_file import CounterFile
from roslens.live.inside.host_counters import HostCounters, counter_folders, place_of
from roslens.live.inside.slots import VARIABLE
from roslens.live.inside.snapshot import snapshot
from roslens.model.traffic.tally import BY_GID

GID = bytes(range(1, 17))


@pytest.fixture
def folder(tmp_path):
    made = tmp_path / "counters"
    made.mkdir(0o700)
    return made


@pytest.fixture
def file(folder):
    made = CounterFile(str(folder), 8)
    yield made
    made.close()


def test_publishers_are_told_by_their_identifiers(folder, file):
    counters = HostCounters("sensor", {VARIABLE: str(folder)})
    assert [tallies for _, tallies in counters.read(time.time())] == [[]]
    for kind, gid in ((slots.TAKEN, GID), (slots.PUBLISHED, b""), (slots.TAKEN, b"")):
        slot = file.slot(kind, gid, f"/topic{kind}{len(gid)}", "/node")
        slot.arrived(time.time_ns(), time.time_ns(), 1000, None, 10, None)
    ((place, tallies),) = counters.read(time.time())
    assert place == place_of(str(folder)) != ""
    assert {(one.publisher, one.subscriber, one.count, one.host) for one in tallies} == {
        (BY_GID + GID.hex(), "/node", 1, "sensor"), ("/node", "", 1, "sensor"), ("", "/node", 1, "sensor"),
    }  # fmt: skip
    assert counters.nodes() == {os.getpid(): frozenset({"/node"})}
    counters.close()


def test_calls_of_services_are_no_traffic_of_topics(folder, file):
    counters = HostCounters("sensor", {VARIABLE: str(folder)})
    now = time.time()
    counters.read(now)
    counters.calls(now)
    ends = [file.slot(kind, b"", "/add", "/server") for kind in (slots.ASKED, slots.REPLIED)]
    for second in (1, 2):
        for end in ends:
            when = int((now + second) * 1e9)
            end.arrived(when, when, None, None, -1, None)
        assert [tallies for _, tallies in counters.read(now + second)] == [[]]
    ((_, samples),) = counters.calls(now + 2)
    assert [(str(one.entity), one.values["calls"]) for one in samples] == [("service:/add", pytest.approx(1.0))]
    counters.close()


@pytest.mark.parametrize("beside", [False, True])
def test_who_reads_beside_an_observer_tidies_nothing_up(folder, beside):
    counters = HostCounters("sensor", {VARIABLE: str(folder)}, beside=beside)
    now = time.time()
    counters.read(now)
    file = CounterFile(str(folder), 8)
    file.slot(slots.PUBLISHED, b"", "/scan", "/lidar").published(time.time_ns(), 10)
    file.release()
    assert [one.count for _, tallies in counters.read(now + 1) for one in tallies] == [1]
    assert file.path.exists() == beside
    assert counters.read(now + 2)[0][1] == []
    counters.close()


def test_what_is_silent_for_long_is_told_once_a_second(folder, file):
    counters = HostCounters("sensor", {VARIABLE: str(folder)})
    now = time.time()
    counters.read(now)
    file.slot(slots.PUBLISHED, b"", "/scan", "/lidar").published(int(now * 1e9), 10)
    counters.read(now + 0.1)
    brisk = [counters.read(now + 0.2 + step / 5)[0][1] for step in range(5)]
    assert all(len(tallies) == 1 for tallies in brisk)
    ends = [tally for tallies in brisk for tally in tallies]
    assert [one.start for one in ends[1:]] == [one.end for one in ends[:-1]]
    quiet = [counters.read(now + 100 + step / 5)[0][1] for step in range(10)]
    assert sum(len(tallies) for tallies in quiet) == 2
    counters.close()


def test_root_reads_the_folders_of_all_users_that_are_theirs(tmp_path):
    mine, foreign = tmp_path / f"roslens-{os.getuid()}", tmp_path / f"roslens-{os.getuid() + 1}"
    for place in (mine, foreign, tmp_path / "roslens-x"):
        place.mkdir()
    assert str(mine) in counter_folders({}, 0, tmp_path)
    assert str(foreign) not in counter_folders({}, 0, tmp_path)
    assert counter_folders({VARIABLE: "/x"}, 0, tmp_path) == ["/x"]
    assert counter_folders({}, 1000, tmp_path) == ["/dev/shm/roslens-1000"]


def test_a_folder_that_is_not_there_is_no_place(tmp_path):
    assert place_of(str(tmp_path / "none")) == ""
    assert place_of(str(tmp_path)) == place_of(str(tmp_path / "."))


@pytest.mark.parametrize("make", [os.mkfifo, lambda path: path.symlink_to("/etc/passwd")])
def test_links_and_pipes_are_refused_and_nobody_waits_for_them(folder, make):
    make(folder / f"7-x{slots.SUFFIX}")
    counters = HostCounters("sensor", {VARIABLE: str(folder)})
    assert counters.read(time.time())[0][1] == []
    assert "cannot be read" in counters.failures()[0].what
    counters.close()


def test_the_first_messages_of_the_first_node_are_counted(tmp_path):
    folder = tmp_path / "later"
    counters = HostCounters("sensor", {VARIABLE: str(folder)})
    now = time.time()
    assert counters.read(now) == []
    file = CounterFile(str(folder), 8)
    file.slot(slots.PUBLISHED, b"", "/scan", "/lidar").published(time.time_ns(), 10)
    ((place, (tally,)),) = counters.read(now + 0.2)
    assert place
    assert tally.count == 1
    counters.close()
    file.close()


def test_who_counts_is_found_without_reading_what(folder, file, monkeypatch):
    counters = HostCounters("sensor", {VARIABLE: str(folder)}, beside=True)
    counters.look(1000.0)
    made = [file.slot(slots.PUBLISHED, b"", f"/topic{number}", f"/node{number}") for number in range(3)]
    counters.look(1001.0)
    assert counters.nodes() == {os.getpid(): frozenset({"/node0", "/node1", "/node2"})}
    copied = []
    monkeypatch.setattr(
        "roslens.live.inside.opened_file.snapshot", lambda words, before: copied.append(1) or snapshot(words)
    )
    for one in made:
        one.published(1, 10)
    made[1].begin(slots.PUBLISHED, b"", "/other", "/late", "")
    counters.look(1002.0)
    assert counters.nodes() == {os.getpid(): frozenset({"/node0", "/late", "/node2"})}
    assert len(copied) == 1
    counters.close()
