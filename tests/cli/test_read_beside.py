"""Computation graphs that are read while pages are served."""

from __future__ import annotations

import sys
import threading
import time
from types import SimpleNamespace

import pytest
from cli.broken_parser import BREAKING

from roslens.cli.check.shown_run import shown_run
from roslens.cli.graph import read_beside
from roslens.cli.graph.graph_configurations import LOOKING
from roslens.cli.graph.read_beside import GraphsBeside
from roslens.cli.graph.site import site_of
from roslens.cli.main import main
from roslens.cli.terminal.streams import NoProgress
from roslens.cli.workplace.workplace import open_store
from roslens.dashboard.routes import PAGES
from roslens.dashboard.view import Request


@pytest.fixture
def view(talking):
    assert main(["check", str(talking), "-q", "--jobs", "1", "--no-graph", "--fail-on", "never"]) == 0
    with open_store(str(talking)) as store:
        yield store.view()


def until(done):
    end = time.monotonic() + 60
    while not done():
        assert time.monotonic() < end
        time.sleep(0.01)


class Here:
    """Answers in this process what a process of its own is asked."""

    def __init__(self, root):
        self.root = root

    def ask(self, function, *given, heard):
        return function(heard, *given)

    def end(self):
        self.root = ""


def test_pages_are_there_before_the_graphs_and_say_how_far_they_are(view, monkeypatch):
    site = site_of(view)
    begun, may_go_on = threading.Event(), threading.Event()
    real = read_beside.read_graphs

    def slow(header, cache, progress, *, quiet):
        progress.step(LOOKING, 8)
        progress.advance(3)
        begun.set()
        assert may_go_on.wait(60)
        return real(header, cache, progress, quiet=quiet)

    monkeypatch.setattr(read_beside, "read_graphs", slow)
    monkeypatch.setattr(read_beside, "WatchedReader", Here)
    beside = GraphsBeside(site, view, None, NoProgress(), quiet=True)
    assert site.reading == "Computation graphs are being read"
    beside.start()
    assert begun.wait(60)
    assert site.reading == "Computation graphs are being read (3 of 8)"
    assert PAGES["overview"](site, Request()) is not None
    assert not site.book.systems
    may_go_on.set()
    until(lambda: not site.reading)
    assert list(site.book.systems) == ["fleet.launch.xml"]
    assert not site.book.counted


def test_what_cannot_be_read_is_told_and_the_pages_stay(view, monkeypatch, capsys):
    def broken(*_given, **_more):
        raise ValueError("the reason")

    site = site_of(view)
    monkeypatch.setattr(read_beside, "read_graphs", broken)
    monkeypatch.setattr(read_beside, "WatchedReader", Here)
    GraphsBeside(site, view, None, NoProgress()).start()
    until(lambda: "could not" in site.reading)
    assert site.reading == "Computation graphs could not be read: the reason"
    assert "the reason" in capsys.readouterr().err
    assert PAGES["overview"](site, Request()) is not None


@pytest.fixture
def broken_by(tmp_path, monkeypatch):
    """Give what makes reading a file end the process that does, wherever it is not this one."""
    hooks = tmp_path / "hooks"
    hooks.mkdir()
    (hooks / "sitecustomize.py").write_text(BREAKING)
    monkeypatch.setenv("PYTHONPATH", str(hooks))
    return lambda *paths: monkeypatch.setenv("BROKEN_BY", ":".join(paths))


@pytest.mark.skipif(sys.platform != "linux", reason="the kernel's bounds are those of Linux")
def test_a_file_that_breaks_its_reader_costs_itself_alone(view, talking, broken_by, capfd):
    second = talking / "talk/launch/second.launch.xml"
    second.write_text((talking / "talk/launch/fleet.launch.xml").read_text())
    broken_by("talk/launch/second.launch.xml", "talk/CMakeLists.txt", "talk/package.xml")
    site = site_of(view)
    GraphsBeside(site, view, None, NoProgress(), quiet=True).start()
    until(lambda: not site.reading)
    assert list(site.book.systems) == ["fleet.launch.xml"]
    told = capfd.readouterr().err.splitlines()
    assert len(told) == 3
    assert all("is left out of computation graphs: " in line and "breaks the parser" in line for line in told)


@pytest.mark.skipif(sys.platform != "linux", reason="the kernel's bounds are those of Linux")
def test_so_it_does_where_a_run_is_made_to_be_shown(talking, broken_by):
    broken_by("talk/package.xml", "talk/talk/nodes.py")
    asked = SimpleNamespace(
        path=str(talking), changed=False, no_store=True, number=None, no_graph=True, no_cache=True, trust=False
    )
    with shown_run(asked, NoProgress()) as made:
        lost = {one.location.path: one.what for one in made.failures() if "breaks the parser" in one.what}
        assert lost.keys() == {"talk/package.xml", "talk/talk/nodes.py"}
        assert {"talk/talk/__init__.py"} <= {file.path for _, file in made.files()}
