"""The stream: what each reader lacks, made once for all."""

from __future__ import annotations

import msgspec
from dashboard.live.made_up_snapshots import walk

from roslens.dashboard.live import snapshot_stream as module
from roslens.dashboard.live.snapshot_stream import SnapshotStream


class Told:
    """A stream of snapshots that a test moves on."""

    def __init__(self, count=40):
        self.snapshots = walk(5, count)
        self.at = 0
        self.stream = SnapshotStream(lambda: self.snapshots[self.at])
        self.stream.look()

    def go(self, steps=1):
        for _ in range(steps):
            self.at += 1
            self.stream.look()


def names(text):
    return [line.partition(b": ")[2].decode() for line in text.splitlines() if line.startswith(b"event")]


def test_who_is_new_is_told_all():
    assert names(Told().stream.since(0)) == ["state"]


def test_who_holds_the_newest_is_told_nothing():
    told = Told()
    assert told.stream.since(told.stream.number_of(told.stream.mark())) == b""


def test_who_missed_some_is_told_these_in_order():
    told = Told()
    held = told.stream.mark()
    told.go(3)
    missed = told.stream.since(told.stream.number_of(held))
    assert names(missed) == ["change"] * 3
    begun = held.partition(".")[0]
    assert [line.decode() for line in missed.splitlines() if line.startswith(b"id")] == [
        f"id: {begun}.{number}" for number in (2, 3, 4)
    ]


def test_who_is_far_behind_is_told_all(monkeypatch):
    monkeypatch.setattr(module, "MOST_KEPT", 5)
    told = Told()
    held = told.stream.mark()
    told.go(5)
    assert names(told.stream.since(told.stream.number_of(held))) == ["change"] * 5
    told.go(1)
    assert names(told.stream.since(told.stream.number_of(held))) == ["state"]


def test_changes_of_many_bytes_are_not_kept(monkeypatch):
    monkeypatch.setattr(module, "MOST_BYTES", 10)
    told = Told()
    held = told.stream.mark()
    told.go(2)
    assert names(told.stream.since(told.stream.number_of(held))) == ["state"]


def test_all_is_told_where_the_changes_are_larger():
    told = Told()
    size = len(told.stream.whole())
    held = told.stream.mark()
    told.go(39)
    missed = told.stream.since(told.stream.number_of(held))
    assert len(missed) <= max(size, len(told.stream.whole()))


def test_every_reader_gets_the_same_bytes():
    told = Told()
    told.stream.since(0)
    assert told.stream.whole() is told.stream.whole()
    told.go(1)
    assert told.stream.since(1) == told.stream.since(1)


def test_a_mark_of_another_monitor_is_not_known():
    other, told = Told(), Told()
    assert told.stream.number_of(other.stream.mark()) == 0
    assert told.stream.number_of(told.stream.mark()) == 1
    ahead = told.stream.mark().replace(".1", ".7")
    assert told.stream.number_of(ahead) == 0


def test_pieces_are_valid_json_of_one_line():
    told = Told()
    told.go(1)
    for text in (told.stream.whole(), told.stream.since(1)):
        (data,) = [line[6:] for line in text.splitlines() if line.startswith(b"data: ")]
        assert isinstance(msgspec.json.decode(data), dict)
