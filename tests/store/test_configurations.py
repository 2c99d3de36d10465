"""Computation graphs kept with runs."""

import sqlite3
from contextlib import closing

import pytest

from roslens.model.configuration import Configuration, ConfiguredNode, Proof
from roslens.model.finding import Finding, Severity
from roslens.model.judged_configuration import JudgedConfiguration
from roslens.store.runs import Store


def judged(name: str, node: str = "/drive") -> JudgedConfiguration:
    finding = Finding("graph.one_end", Severity.NOTE, "one end only", "a.py", 3, entity=f"node:{node}", fingerprint="f")
    return JudgedConfiguration(name, Configuration("a.launch.py", "ros2", (ConfiguredNode(node, Proof()),)), (finding,))


@pytest.fixture
def write(sample, tmp_path):
    """Return a function that writes a run that looked at configurations, and returns its number."""

    def written(store, key, *found):
        header = sample.header(key)
        with store.writing(header) as writer:
            writer.add("unit-arm", sample.arm())
            return writer.complete(sample.workspace(), header, found)

    return written


def graphs(path) -> int:
    with closing(sqlite3.connect(path)) as connection:
        return connection.execute("SELECT count(*) FROM graph").fetchone()[0]


def test_they_come_back_in_their_order(tmp_path, write):
    found = (judged("robot"), judged("arm", "/arm"))
    with Store.open(tmp_path / "store.sqlite") as store:
        write(store, "a", *found)
        assert store.view().configurations() == found


def test_a_run_that_looked_at_none_has_none(write):
    with Store.open(None) as store:
        write(store, "a")
        assert store.view().configurations() == ()


def test_runs_share_one_and_the_last_takes_it_along(tmp_path, write):
    path = tmp_path / "store.sqlite"
    with Store.open(path) as store:
        write(store, "a", judged("robot"))
        write(store, "b", judged("robot"))
        assert graphs(path) == 1
        write(store, "c", judged("robot", "/other"))
        assert graphs(path) == 2
        store.prune(1)
        assert graphs(path) == 1
        assert store.view().configurations() == (judged("robot", "/other"),)


def test_names_that_utf_8_cannot_write_cost_nothing(write):
    with Store.open(None) as store:
        write(store, "a", judged("robot\udcff"))
        assert [one.name for one in store.view().configurations()] == ["robot\\xff"]


def test_what_another_version_described_otherwise_is_none(tmp_path, write):
    path = tmp_path / "store.sqlite"
    with Store.open(path) as store:
        write(store, "a", judged("robot"))
        with closing(sqlite3.connect(path)) as connection, connection:
            connection.execute("UPDATE graph SET content = ?", (b"x",))
        assert store.view().configurations() == ()
