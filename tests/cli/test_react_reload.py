"""A reference that changes under way: taken over whole once all of it can be done, else the old one holds on."""

from __future__ import annotations

import os

import pytest

from roslens.cli.react.react_reload import Renewal
from roslens.cli.watch.watch_reload import ReferenceFiles
from roslens.live.join.session import Session, Step
from roslens.live.react.prepared import Prepared
from roslens.live.react.reactor import Reactor
from roslens.model.acting.order import VERSION, Reply, Verb

HEAD = "kind: reference\nname: r\nconstraints: [{node: /a, expected: always}]\nreactions:\n"
SNAPSHOT = "- {id: one, when: {node: /a, is: gone}, do: [{snapshot: {}}]}\n"
SAY = "- {id: two, when: {node: /a, is: gone}, do: [{notify: gone}]}\n"


class Scene:
    """Files, a reactor, a line to ROS that answers when the script says so, and a journal that is a list."""

    generation = 2

    def __init__(self, path):
        self.path, self.now = path, 0.0
        self.asked, self.forgotten, self.entries = [], [], []
        self.prepared = self.holding = None
        path.write_text(HEAD + SNAPSHOT)
        self.files = ReferenceFiles([path], steady=lambda: self.now)
        self.reactor = Reactor(self.files.reference.reactions, start=0.0)
        self.session = Session(self.files.reference, start=0.0)
        self.renewal = Renewal(self.files, self.session, self.reactor, self, self, steady=lambda: self.now)

    def prepare(self, id_, *_):
        self.asked.append(id_)

    def forget(self, id_):
        self.forgotten.append(id_)

    def prepare_next(self, reactions):
        self.prepared = Prepared(len(self.entries) + 1)
        self.prepared.ask([self], reactions)
        return self.prepared

    def take_next(self):
        self.holding = self.prepared

    def drop_next(self):
        self.prepared = None

    def add(self, what, time, **fields):
        self.entries.append((what, fields))

    def answer(self, text=""):
        for id_ in self.asked:
            self.prepared.take(2, Reply(VERSION, id_, Verb.PREPARE, not text, text))

    def write(self, text):
        before = self.path.stat()
        self.path.write_text(text)
        os.utime(self.path, ns=(before.st_atime_ns, before.st_mtime_ns + 1))

    def looks(self, count=4):
        reported = []
        for _ in range(count):
            self.now += 1.0
            reported += self.renewal.look(Step(self.now)).notes
        return [one.kind.value for one in reported]

    @property
    def names(self):
        return [one.name for one in self.files.reference.reactions]

    @property
    def holds(self):
        return [plan.reaction.name for plan in self.reactor._plans]


@pytest.fixture
def scene(tmp_path):
    return Scene(tmp_path / "r.yaml")


def test_what_is_new_holds_once_all_of_it_can_be_done(scene):
    scene.write(HEAD + SNAPSHOT + SAY)
    assert scene.looks() == []
    assert scene.asked == ["r.two/prepare.1@1"]
    assert scene.holds == ["r.one"]
    scene.answer()
    assert scene.looks() == ["reloaded"]
    assert scene.holds == ["r.one", "r.two"]
    assert scene.holding is scene.prepared
    ((what, fields),) = scene.entries
    assert (what, fields["reactions"]) == ("reloaded", ["r.one", "r.two"])


def test_a_wrong_document_is_refused_with_its_place_and_the_old_one_holds(scene):
    scene.write(HEAD + "- {id: one, when: {node: /a, is: asleep}, do: [{snapshot: {}}]}\n")
    assert scene.looks() == ["kept"]
    ((what, fields),) = scene.entries
    assert what == "kept"
    assert f"{scene.path}:5:" in fields["text"]
    assert "asleep" in fields["text"]
    assert scene.holds == ["r.one"]
    scene.write(HEAD + SNAPSHOT + SAY)
    scene.looks()
    scene.answer()
    assert scene.looks() == ["reloaded"]


def test_what_no_ros_can_do_is_refused_with_its_place(scene):
    scene.write(HEAD + SAY)
    scene.looks()
    scene.answer("no such type")
    assert scene.looks() == ["kept"]
    ((_, fields),) = scene.entries
    assert fields["place"].startswith(f"{scene.path}:5:")
    assert "no such type" in fields["text"]
    assert scene.holds == ["r.one"]
    assert scene.holding is None


def test_a_ros_that_never_answers_is_waited_for_no_longer_than_half_a_minute(scene):
    scene.write(HEAD + SAY)
    assert scene.looks(25) == []
    assert scene.looks(15) == ["kept"]
    assert "not answered yet" in scene.entries[0][1]["text"]


def test_a_file_that_is_broken_while_another_reading_is_prepared_ends_that(scene):
    scene.write(HEAD + SNAPSHOT + SAY)
    scene.looks()
    prepared = scene.prepared
    scene.write("no document")
    assert scene.looks() == ["kept"]
    assert scene.prepared is None
    assert prepared.waiting()
    assert scene.looks(40) == []
    assert scene.holds == ["r.one"]
