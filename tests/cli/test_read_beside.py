"""Computation graphs that are read while pages are served."""

from __future__ import annotations

import threading
import time

import pytest

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


def test_pages_are_there_before_the_graphs_and_say_how_far_they_are(view, monkeypatch):
    site = site_of(view)
    begun, may_go_on = threading.Event(), threading.Event()
    real = read_beside.shown_graphs

    def slow(view, cache, progress, *, quiet):
        progress.step(LOOKING, 8)
        progress.advance(3)
        begun.set()
        assert may_go_on.wait(60)
        return real(view, cache, progress, quiet=quiet)

    monkeypatch.setattr(read_beside, "shown_graphs", slow)
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
    monkeypatch.setattr(read_beside, "shown_graphs", broken)
    GraphsBeside(site, view, None, NoProgress()).start()
    until(lambda: "could not" in site.reading)
    assert site.reading == "Computation graphs could not be read: the reason"
    assert "the reason" in capsys.readouterr().err
    assert PAGES["overview"](site, Request()) is not None
