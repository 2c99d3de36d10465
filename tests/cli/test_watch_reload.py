"""References that are read again: real files, a scripted system, and no clock but the script's."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from roslens.cli.watch.watch_reload import ReferenceFiles
from roslens.live.join.note import NoteKind
from roslens.live.join.session import Session
from roslens.model.errors import DocumentError
from roslens.model.traffic.tally import Moments, Tally
from roslens.model.verdict import State
from roslens.model.wire import VERSION, Frame

HEAD = "kind: reference\nname: {}\ndefaults: {{grace: 0 s}}\n"
MOST = "constraints:\n  - {topic: /scan, rate: '>= 1 Hz'}\n"
SCAN = "constraints:\n  - {topic: /scan, rate: 8..12 Hz}\n"


class Script:
    """A clock, and a robot whose /scan has 5 Hz."""

    def __init__(self, *paths: Path):
        self.now = 0.0
        self.files = ReferenceFiles(paths, steady=lambda: self.now)
        self.session = Session(self.files.reference, start=0.0)

    def second(self):
        self.now += 1.0
        period = Moments(5, 1.0, 5 * 0.04, 0.2, 0.2)
        tally = Tally("/scan", "/a", "", self.now - 1, self.now, 5, 50, self.now - 0.9, self.now - 0.1, period)
        self.session.take([Frame(VERSION, "script", 0, self.now, [tally])])
        step = self.session.look(self.now)
        notes = self.files.look(self.now)
        if notes:
            self.session.monitor.replace_reference(self.files.reference)
        return step, notes

    def seconds(self, count):
        steps = [self.second() for _ in range(count)]
        changes = [(one.expectation, one.state) for step, _ in steps for one in step.changes]
        return changes, [note for _, notes in steps for note in notes]


def write(path: Path, text: str) -> Path:
    """Write a file as if some time had passed since the last time, whatever the clock's resolution."""
    before = path.stat().st_mtime_ns if path.exists() else 0
    path.write_text(text)
    about = path.stat()
    os.utime(path, ns=(about.st_atime_ns, max(about.st_mtime_ns, before + 1)))
    return path


@pytest.fixture
def main(tmp_path):
    return write(tmp_path / "main.yaml", HEAD.format("main") + "include: part.yaml\n" + SCAN)


@pytest.fixture
def part(tmp_path):
    return write(tmp_path / "part.yaml", HEAD.format("part") + "constraints: []\n")


def test_a_change_is_read_and_what_stays_keeps_its_state(main, part):
    script = Script(main)
    assert script.seconds(5) == ([("main.topic.scan.rate", State.LOW)], [])
    (before,) = script.session.monitor.standing()
    more = SCAN + "  - {topic: /scan, bandwidth: '<= 1 B/s'}\n"
    write(main, HEAD.format("main") + "include: part.yaml\n# a comment\n" + more)
    changes, (note,) = script.seconds(4)
    assert (note.kind, note.text) == (NoteKind.RELOADED, f"read {main} again: 2 constraints")
    assert changes == [("main.topic.scan.bandwidth", State.HIGH)]
    after = script.session.monitor.standing()[1]
    assert (after.state, after.since, after.where) == (State.LOW, before.since, f"{main}:7")


def test_what_is_included_counts_too(main, part):
    script = Script(main)
    script.seconds(3)
    write(part, HEAD.format("part") + MOST)
    changes, (note,) = script.seconds(4)
    assert note.text == f"read {part} again: 2 constraints"
    assert ("part.topic.scan.rate", State.OK) in changes


def test_a_broken_document_is_told_once_and_the_old_one_holds(main, part):
    script = Script(main)
    script.seconds(5)
    write(main, HEAD.format("main") + "constraints:\n  - {topic: /scan, raet: 8..12 Hz}\n")
    changes, (note,) = script.seconds(8)
    assert changes == []
    assert note.kind is NoteKind.KEPT
    assert note.text.startswith(
        f"the reference as it was before holds on: {main}:5:20: unknown key 'raet' of a constraint"
    )
    assert "Did you mean 'rate'?" in note.text
    assert script.files.broken
    assert [one.state for one in script.session.monitor.standing()] == [State.LOW]
    write(main, HEAD.format("main") + SCAN.replace("8", "4"))
    changes, (note,) = script.seconds(4)
    assert note.kind is NoteKind.RELOADED
    assert not script.files.broken
    assert [one.state for one in script.session.monitor.standing()] == [State.OK]


def test_a_file_that_is_missing_is_waited_for(main, part):
    script = Script(main)
    part.unlink()
    _, (note,) = script.seconds(3)
    assert note.text.startswith(f"the reference as it was before holds on: {main}:4:10: no file 'part.yaml'")
    write(part, HEAD.format("part") + MOST)
    _, (note,) = script.seconds(3)
    assert note.text == f"read {part} again: 2 constraints"


def test_a_new_include_is_followed(main, part, tmp_path):
    script = Script(main)
    other = tmp_path / "other.yaml"
    write(main, HEAD.format("main") + "include: [part.yaml, other.yaml]\n" + SCAN)
    _, (note,) = script.seconds(3)
    assert "no file 'other.yaml'" in note.text
    write(other, HEAD.format("other") + MOST)
    assert [note.kind for note in script.seconds(3)[1]] == [NoteKind.RELOADED]
    write(other, HEAD.format("other") + "constraints: []\n")
    assert [note.kind for note in script.seconds(3)[1]] == [NoteKind.RELOADED]


def test_a_touch_is_no_change_and_files_are_looked_at_once_a_second(main, part, monkeypatch):
    script = Script(main)
    about = main.stat()
    os.utime(main, ns=(about.st_atime_ns, about.st_mtime_ns + 10**9))
    assert script.seconds(4)[1] == []
    looks = []
    monkeypatch.setattr("roslens.cli.watch.watch_reload._stamps", lambda paths: looks.append(1) or {})
    for _ in range(100):
        script.now += 0.01
        script.files.look(script.now)
    assert len(looks) <= 1


def test_a_file_that_is_being_written_is_read_when_it_is_done(main, part):
    script = Script(main)
    whole = HEAD.format("main") + SCAN.replace("8", "4")
    for end in (10, 40, 60):
        write(main, whole[:end])
        assert script.seconds(1)[1] == []
    write(main, whole)
    assert [note.kind for note in script.seconds(3)[1]] == [NoteKind.RELOADED]


def test_a_wrong_document_does_not_begin(tmp_path):
    with pytest.raises(DocumentError, match="cannot read it"):
        ReferenceFiles([tmp_path / "none.yaml"], steady=lambda: 0.0)
    assert ReferenceFiles([], steady=lambda: 0.0).reference.expectations == ()
