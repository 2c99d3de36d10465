"""A large history: what a page asks reads about as much of it, however much is kept."""

from __future__ import annotations

import sqlite3
from collections.abc import Callable, Iterator
from contextlib import closing, contextmanager
from pathlib import Path

import msgspec
import pytest

from roslens.model.entity import EntityId, EntityKind
from roslens.model.graph import Graph
from roslens.model.verdict import State, Verdict
from roslens.store.live.history import History
from roslens.store.past import recall as module
from roslens.store.past.moment import Moment
from roslens.store.past.recall import Recall

START = 1_700_000_000
SCAN = EntityId(EntityKind.TOPIC, "/scan")
STEP = 100
"""Instructions of the virtual machine of SQLite between two counts."""
DAY_S = 86_400


class Large:
    """A history of so many days: an alarm and an event every two seconds, ten series in tiers as a watch keeps them."""

    def __init__(self, path: Path, days: int) -> None:
        self.last = START + days * DAY_S
        with History.open(path) as history:
            one = Verdict(SCAN, "r.scan", "rate", State.LOW, START, START, 4.0, "8..12 Hz")
            for time in (START, self.last - 200):
                history.add_moment(Moment(time, Graph("ros2", (), ()), (one,)))
            history.flush()
        self._fill(path, msgspec.json.encode(one).decode())
        self._path = path
        self._steps = 0
        self.recall = Recall(self._lent, str(path))

    def _fill(self, path: Path, content: str) -> None:
        seconds = self.last - START
        upto = "WITH RECURSIVE n(i) AS (SELECT 0 UNION ALL SELECT i + 1 FROM n WHERE i < ?)"
        with closing(sqlite3.connect(path)) as connection, connection:
            connection.execute(f"{upto} INSERT INTO series SELECT i + 1, 'topic:/t' || i, 'rate' FROM n", (9,))
            for tier, length in ((1, min(seconds, 3600)), (10, min(seconds, 7200)), (60, seconds)):
                connection.execute(
                    f"{upto} INSERT INTO point SELECT series.id, ?, ? - i * ?, 1, 9.0, 9.0, 9.0 FROM n, series",
                    (length // tier, tier, self.last // tier * tier, tier),
                )
            connection.execute(
                f"{upto} INSERT INTO verdict (time, entity, state, content)"
                " SELECT ? + i * 2, 'topic:/scan', 'low', ? FROM n",
                (seconds // 2, START, content),
            )
            connection.execute(
                f"{upto} INSERT INTO event (time, entity, change, detail)"
                " SELECT ? + i * 2, 'node:/a', 'appeared', '' FROM n",
                (seconds // 2, START),
            )

    @contextmanager
    def _lent(self) -> Iterator[sqlite3.Connection]:
        def step() -> int:
            self._steps += STEP
            return 0

        with closing(sqlite3.connect(self._path)) as connection:
            connection.set_progress_handler(step, STEP)
            yield connection

    def steps(self, ask: Callable[[Recall, float], object]) -> int:
        """Return how many steps an answer about the end of what is kept takes."""
        before = self._steps
        assert ask(self.recall, self.last) is not None
        return self._steps - before


@pytest.fixture(scope="module")
def histories(tmp_path_factory: pytest.TempPathFactory) -> tuple[Large, Large]:
    folder = tmp_path_factory.mktemp("large")
    return Large(folder / "short.sqlite", 1), Large(folder / "long.sqlite", 10)


@pytest.mark.parametrize(
    "ask",
    [
        lambda recall, last: recall.span(),
        lambda recall, last: recall.moment(last),
        lambda recall, last: recall.values(last),
        lambda recall, last: recall.happened(last, 50),
        lambda recall, last: recall.stretches("topic:/t1", last - 300, last, 600),
        lambda recall, last: recall.marks(last - 300, last),
        lambda recall, last: recall.marks(START, last),
    ],
    ids=["span", "moment", "values", "happened", "plot", "marks", "marks of all"],
)
def test_an_answer_of_ten_times_as_much_costs_about_the_same(
    histories: tuple[Large, Large], monkeypatch: pytest.MonkeyPatch, ask: Callable[[Recall, float], object]
) -> None:
    monkeypatch.setattr(module, "MOST_MARKED", 5_000)
    short, long = (one.steps(ask) for one in histories)
    assert long < 2 * short + 20_000


def test_of_very_many_marks_the_newest_are_told(
    histories: tuple[Large, Large], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(module, "MOST_MARKED", 5_000)
    long = histories[1]
    found = long.recall.marks(START, long.last)
    assert found[-1].time > long.last - DAY_S
    assert sum(one.count for one in found if one.kind == "alarm") == 5_000


HUGE = 10 * 2**30
"""Bytes of what a watch of a large robot keeps in months."""


def grow(path: Path) -> None:
    """Make a file of SQLite as long as :data:`HUGE`, with a hole in place of the pages."""
    with closing(sqlite3.connect(path)) as connection:
        connection.execute("PRAGMA wal_checkpoint(TRUNCATE)")
        (page,) = connection.execute("PRAGMA page_size").fetchone()
    with path.open("r+b") as file:
        counter = file.read(28)[24:]
        file.seek(28)
        file.write((HUGE // page).to_bytes(4, "big"))
        # By this the length is known to be of this state of the file.
        file.seek(92)
        file.write(counter)
        file.truncate(HUGE)


def read_so_far() -> int:
    """Return how many bytes this thread has read of files."""
    text = Path("/proc/thread-self/io").read_text(encoding="ascii")
    return int(text.partition("rchar: ")[2].split()[0])


def test_ten_gigabytes_are_opened_added_to_and_asked_without_being_read(tmp_path: Path) -> None:
    path = tmp_path / "huge.sqlite"
    large = Large(path, 1)
    grow(path)
    before = read_so_far()
    with History.open(path) as history:
        assert history.size >= HUGE
        history.add_moment(Moment(large.last + 1, Graph("ros2", (), ()), ()))
        history.flush()
    assert large.recall.span() is not None
    assert large.recall.moment(large.last) is not None
    assert large.recall.happened(large.last, 50)
    assert large.recall.stretches("topic:/t1", large.last - 300, large.last, 600)
    assert read_so_far() - before < 2**21
    found = path.stat()
    assert found.st_size >= HUGE
    assert found.st_blocks * 512 < 2**27, "nothing rewrites it"
