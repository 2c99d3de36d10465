"""An analysis of past revisions that is killed goes on where it was: every revision once, and the same of each."""

import contextlib
import json
import random
import shutil
import signal
import sqlite3
import subprocess

import pytest
from process_metrics.small_repository import MANIFEST, SmallRepository, function

from killed.place import ROSLENS
from roslens.cli.main import main

pytestmark = [pytest.mark.heavy, pytest.mark.timed]

COMMITS = 14
SEED = 15


@pytest.fixture(scope="module")
def repository(tmp_path_factory):
    one = SmallRepository(tmp_path_factory.mktemp("history") / "w")
    for number in range(COMMITS):
        one.commit(f"{number}", day=number, p__package_DOT_xml=MANIFEST.format("p"), p__a_DOT_cpp=function("a", number))
    return one


def history(folder):
    return subprocess.Popen(
        [*ROSLENS, "history", str(folder), "--every", "1", "-q"], stderr=subprocess.PIPE, start_new_session=True
    )


def done(folder):
    """Return how many revisions are kept."""
    path = folder / ".roslens/history.sqlite"
    with (
        contextlib.suppress(sqlite3.Error),
        contextlib.closing(sqlite3.connect(f"file:{path}?mode=ro", uri=True)) as kept,
    ):
        return kept.execute("SELECT count(*) FROM revision").fetchone()[0]
    return 0


def known(folder, capsys):
    """Return what is kept: the commit of each revision, rows of the tables, and how a quantity went."""
    with contextlib.closing(sqlite3.connect(folder / ".roslens/history.sqlite")) as kept:
        commits = [row[0] for row in kept.execute('SELECT "commit" FROM revision ORDER BY run')]
        tables = ("run", "unit", "run_unit", "entity", "measured", "finding", "failure", "package_value")
        rows = {one: kept.execute(f"SELECT count(*) FROM {one}").fetchone()[0] for one in tables}
        assert kept.execute("PRAGMA integrity_check").fetchall() == [("ok",)]
    assert main(["trend", "cyclomatic_complexity.max", str(folder), "--format", "json"]) == 0
    trend = json.loads(capsys.readouterr().out)
    return commits, rows, trend


def ended(folder, kills, chance):
    """Analyse the revisions of a folder, and kill that so many times at random moments."""
    for _ in range(kills):
        process = history(folder)
        wanted = done(folder) + chance.randint(0, 3)
        while process.poll() is None and done(folder) < wanted:
            pass
        with contextlib.suppress(subprocess.TimeoutExpired):
            process.wait(chance.uniform(0, 0.3))
        process.send_signal(signal.SIGKILL)
        process.communicate()
    process = history(folder)
    said = process.communicate()[1].decode()
    assert process.returncode == 0, said


@pytest.fixture(scope="module")
def usual(repository):
    folder = repository.root.with_name("usual")
    shutil.copytree(repository.root, folder)
    ended(folder, 0, None)
    return folder


@pytest.mark.parametrize("kills", [3, pytest.param(40, marks=[pytest.mark.nightly, pytest.mark.timeout(1800)])])
def test_killed_again_and_again(repository, usual, tmp_path, capsys, kills):
    seed = SEED if kills == 3 else random.SystemRandom().randrange(10**9)
    shutil.copytree(repository.root, tmp_path / "w")
    ended(tmp_path / "w", kills, random.Random(seed))
    found, expected = known(tmp_path / "w", capsys), known(usual, capsys)
    assert len(expected[0]) == COMMITS == len(set(expected[0]))
    assert found == expected, seed
