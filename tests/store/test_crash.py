"""A process that dies at any moment leaves the last complete run."""

import random
import sqlite3
import subprocess
import sys
from contextlib import closing

import pytest

from roslens.store.runs import Store

WRITER = """
import importlib.util, sys
from pathlib import Path
from roslens.model.result import WorkspaceResult
from roslens.store.runs import Store
spec = importlib.util.spec_from_file_location("report_sample", sys.argv[2])
sample = importlib.util.module_from_spec(spec)
spec.loader.exec_module(sample)
print("ready", flush=True)
for number in range(int(sys.argv[3]), 100_000):
    header = sample.header(f"key-{number}")
    with Store.open(Path(sys.argv[1])) as store:
        with store.writing(header) as writer:
            for key, result in sample.large(6, first=number):
                (writer.reuse(key) if store.has_unit(key) else writer.add(key, result))
            done = writer.complete(WorkspaceResult(package_values={"package_0001": {"tier": 1}}), header)
        print(done, flush=True)
        if number % 5 == 0:
            store.prune(3)
"""


@pytest.mark.heavy
@pytest.mark.timed
def test_killed_at_random_moments(tmp_path, sample):
    path = tmp_path / "store.sqlite"
    moments = random.Random(20240501)
    number = tries = 0
    # A busy machine may give the first writers no time to complete a run.
    while tries < 15 or (number <= 3 and tries < 60):
        tries += 1
        process = subprocess.Popen(
            [sys.executable, "-c", WRITER, str(path), sample.__file__, str(number)], stdout=subprocess.PIPE, text=True
        )
        with process:
            assert process.stdout.readline() == "ready\n"
            with pytest.raises(subprocess.TimeoutExpired):
                process.wait(moments.uniform(0.0, 0.7))
            process.kill()
            finished = [int(line) for line in process.stdout.read().split() if line]
        if not path.exists():
            continue
        with Store.open(path, wait_s=1) as store:
            assert (store.latest() or 0) >= max(finished, default=0)
            for run in store.runs():
                view = store.view(run.id)
                assert len(view.packages()) == run.packages == 6
                assert sum(1 for _ in view.entities()) == run.entities == 6 * 160
                assert view.count_findings() == run.findings == 6 * 106
            number = int(store.runs()[0].header.key.partition("-")[2]) + 1 if store.runs() else 0
        with closing(sqlite3.connect(path)) as connection:
            assert connection.execute("PRAGMA integrity_check").fetchall() == [("ok",)]
            assert connection.execute("PRAGMA foreign_key_check").fetchall() == []
    assert number > 3
