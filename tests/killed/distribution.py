"""A distribution that is fetched and checked by a cluster into a shared store, while its parts are killed."""

from __future__ import annotations

import json
import os
import random
import shutil
import signal
import socket
import subprocess
import sys
import time
from collections.abc import Iterator, Sequence
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import NamedTuple

from postgres_server import PostgresServer

from killed.place import LONG, PACKAGE, ROSLENS, wait_for

PARTS = ("worker", "cluster", "database", "command")
REPOSITORIES, PACKAGES = 4, 6
"""Repositories of the distribution, and packages of each."""
ENDS_S = 240.0
"""A command that nobody ends takes some seconds; one whose cluster was killed waits for another."""
TABLES = (
    "run", "unit", "run_unit", "file", "entity", "measured", "finding", "failure", "set_aside", "package_value",
    "tag_set", "vocabulary",
)  # fmt: skip

SCHEDULER = """
import asyncio, sys
from distributed import Nanny, Scheduler

async def run():
    async with Scheduler(host="127.0.0.1", port=int(sys.argv[1]), dashboard=False) as scheduler:
        workers = [
            await Nanny(scheduler.address, nthreads=1, host="127.0.0.1", dashboard=False, memory_limit=0)
            for _ in range(2)
        ]
        print("ready", flush=True)
        await asyncio.get_running_loop().run_in_executor(None, sys.stdin.read)

if __name__ == "__main__":
    asyncio.run(run())
"""


class Strike(NamedTuple):
    """Which part is killed, and at which share of an undisturbed run's time."""

    part: str
    share: float


def drawn(many: int, seed: int) -> list[Strike]:
    """Return strikes at random moments of a run, the first one first: each part in turn, in random order."""
    chance = random.Random(seed)
    parts = [part for _ in range(-(-many // len(PARTS))) for part in chance.sample(PARTS, len(PARTS))]
    shares = sorted(chance.random() for _ in range(many))
    return list(map(Strike, parts, shares))


class Cluster:
    """A scheduler of Dask with two workers, always at the same address."""

    def __init__(self, folder: Path) -> None:
        with socket.socket() as free:
            free.bind(("127.0.0.1", 0))
            self.port = free.getsockname()[1]
        self.address = f"tcp://127.0.0.1:{self.port}"
        self._folder = folder
        folder.mkdir()
        (folder / "cluster.py").write_text(SCHEDULER)
        self._process: subprocess.Popen[str] | None = None

    def start(self) -> None:
        """Start it, and wait for its workers."""
        self._process = subprocess.Popen(
            [sys.executable, "cluster.py", str(self.port)], cwd=self._folder, stdin=subprocess.PIPE,
            stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True, start_new_session=True,
            env={**os.environ, "PYTHONSAFEPATH": "1"},
        )  # fmt: skip
        assert self._process.stdout is not None
        assert self._process.stdout.readline() == "ready\n"

    def kill_worker(self, chance: random.Random) -> None:
        """Kill one of its workers; another one takes its place."""
        assert self._process is not None
        workers = _workers(self._process.pid)
        if workers:
            with suppress(ProcessLookupError):
                os.kill(chance.choice(workers), signal.SIGKILL)

    def kill(self) -> None:
        """Kill scheduler and workers."""
        if self._process is not None:
            with suppress(ProcessLookupError):
                os.killpg(self._process.pid, signal.SIGKILL)
            self._process.communicate()
            self._process = None


def _workers(scheduler: int) -> list[int]:
    found = []
    for task in Path(f"/proc/{scheduler}/task").iterdir():
        with suppress(OSError):
            found += [int(one) for one in (task / "children").read_text().split()]
    return [pid for pid in found if b"spawn_main" in Path(f"/proc/{pid}/cmdline").read_bytes()]


def make_repositories(folder: Path) -> None:
    """Write git repositories with packages, and ``set.repos`` that names them."""
    entries = {}
    for repository in range(REPOSITORIES):
        place = folder / "server" / f"r{repository}"
        for number in range(PACKAGES):
            name = f"p{repository}{number}"
            package = place / name
            package.mkdir(parents=True)
            (package / "package.xml").write_text(PACKAGE.replace(">arm<", f">{name}<"))
            functions = 4 + 3 * number
            (package / "a.cpp").write_text("".join(LONG.format(f"{name}_{one}") for one in range(functions)))
        words = ["git", "-C", str(place), "-c", "user.name=a", "-c", "user.email=a@example.org"]
        for command in (["init", "-q", "-b", "main"], ["add", "-A"], ["commit", "-q", "-m", "c"]):
            subprocess.run([*words, *command], check=True)
        entries[place.name] = {"type": "git", "url": f"file://{place}/.git", "version": "main"}
    (folder / "set.repos").write_text(json.dumps({"repositories": entries}))


@contextmanager
def started(folder: Path, store: str, *more: str) -> Iterator[subprocess.Popen[bytes]]:
    """Start the fetch and the check of the distribution into ``folder``/ws; all is gone afterwards."""
    shutil.copy(folder.parent / "set.repos", folder)
    words = ["check", "--fetch", "--distribution", "set.repos", "--into", "ws", "--fail-on", "never", "-q",
             "--no-graph", "--format", "json", "-o", "run.json", *more]  # fmt: skip
    environment = {**os.environ, "ROSLENS_STORE": store, "PYTHONDONTWRITEBYTECODE": "1"}
    process = subprocess.Popen(
        [*ROSLENS, *words], cwd=folder, env=environment, start_new_session=True, stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
    )  # fmt: skip
    try:
        yield process
    finally:
        with suppress(ProcessLookupError):
            os.killpg(process.pid, signal.SIGKILL)
        process.communicate()


def result(folder: Path) -> dict[str, object]:
    """Return what the last command wrote, without when and where it ran."""
    found = json.loads((folder / "run.json").read_text())
    del found["run"]
    return found


def kept(server: PostgresServer, schema: str) -> dict[str, int]:
    """Return how many rows each table of a shared store has."""
    import psycopg

    with psycopg.connect(server.address) as connection:
        return {
            table: connection.execute(f'SELECT count(*) FROM "{schema}"."{table}"').fetchone()[0] for table in TABLES
        }


def undisturbed(folder: Path, server: PostgresServer, cluster: Cluster) -> float:
    """Run the command in ``folder`` to its end into the schema ``undisturbed``; return its seconds."""
    folder.mkdir()
    begun = time.monotonic()
    with started(folder, server.schema("undisturbed"), "--engine", cluster.address) as process:
        said, _ = process.communicate(timeout=ENDS_S)
        assert process.returncode == 0, said.decode()
    return time.monotonic() - begun


class Disturbed(NamedTuple):
    """What the command said each time that it failed, and strikes of which the moment did not come."""

    said: list[str]
    left: list[Strike]


def disturbed(
    folder: Path, server: PostgresServer, cluster: Cluster, schema: str, strikes: Sequence[Strike], seconds: float
) -> Disturbed:
    """Run the command while its parts are killed, and again until it comes to its end."""
    chance = random.Random(f"{strikes}")
    folder.mkdir()
    left = list(strikes)
    said: list[str] = []
    begun = time.monotonic()
    for _ in range(2 * len(strikes) + 2):
        with started(folder, server.schema(schema), "--engine", cluster.address) as process:
            while left and _lives_until(process, begun + seconds * left[0].share):
                _struck(left.pop(0).part, server, cluster, process, chance)
            out, _ = process.communicate(timeout=ENDS_S)
        if process.returncode == 0:
            return Disturbed(said, left)
        said.append(f"{process.returncode}: {out.decode(errors='replace')}")
    raise AssertionError(f"it does not come to an end: {said}")


def _lives_until(process: subprocess.Popen[bytes], moment: float) -> bool:
    with suppress(subprocess.TimeoutExpired):
        process.wait(max(0.0, moment - time.monotonic()))
        return False
    return True


def _struck(
    part: str, server: PostgresServer, cluster: Cluster, process: subprocess.Popen[bytes], chance: random.Random
) -> None:
    if part == "worker":
        cluster.kill_worker(chance)
    elif part == "cluster":
        cluster.kill()
        cluster.start()
    elif part == "database":
        server.kill()
        server.start()
    else:
        process.kill()
        assert wait_for(lambda: process.poll() is not None, 30)
