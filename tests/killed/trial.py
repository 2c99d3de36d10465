"""One command, ended at one moment: what is there afterwards, and what the next run says."""

from __future__ import annotations

import contextlib
import os
import random
import resource
import shutil
import signal
import sqlite3
import subprocess
import tempfile
import time
from pathlib import Path
from typing import NamedTuple

from killed.place import Place, place, wait_for, write_workspace
from roslens.cli.workplace.own_results import key_of_store
from roslens.store.live.history import History
from roslens.store.runs import Store
from roslens.store.sealing.seals import seal_all

BEFORE, AFTER = 2, 3
"""Functions at fault in the run before, and in the one that is ended."""
COMMANDS = {
    "check": ["check", "ws", "--jobs", "2", "--fail-on", "never"],
    "report": ["report", "ws", "-o", "out"],
    "watch": ["watch", "--listen", "127.0.0.1:0", "--key-file", "key", "--history", "live.sqlite", "--for", "1 s",
              "--fail-on", "never", "--format", "json"],
    "agent": ["agent", "127.0.0.1:9", "--key-file", "key", "--name", "base"],
}  # fmt: skip
WAYS = ("request", "kill", "memory", "disk")
ENDS_S = 30.0
"""All that a command started is gone so long after it; a calm machine takes a tenth of a second."""


class Moment(NamedTuple):
    """Which command is ended in which way, and where between its start and its end."""

    command: str
    way: str
    share: float


class Usual(NamedTuple):
    """What a command that nobody ends takes and leaves."""

    seconds: float
    files: set[str]


def drawn(many: int, seed: int) -> list[Moment]:
    """Return moments: every way of every command in turn, at random shares of its time."""
    chance = random.Random(seed)
    pairs = [(command, way) for way in WAYS for command in COMMANDS]
    chance.shuffle(pairs)
    return [Moment(*pairs[number % len(pairs)], chance.random()) for number in range(many)]


def prepared(where: Place) -> None:
    """Have a workspace with a run, a report and a history, and another source than that of the run."""
    inside = where.inside
    write_workspace(inside / "ws", BEFORE)
    for words in (COMMANDS["check"], COMMANDS["report"], ["agent", "--new-key", "key"], COMMANDS["watch"]):
        finished(where, words)
    write_workspace(inside / "ws", AFTER)


def copied(template: Path, where: Place) -> None:
    """Put what was prepared into a place, with results that are marked and sealed as made there."""
    shutil.copytree(template, where.inside, dirs_exist_ok=True)
    store = where.inside / "ws/.roslens/store.sqlite"
    key = key_of_store(store, os.environ)
    with tempfile.TemporaryDirectory() as copies:
        # SQLite follows the path of a place to where it is not.
        copy = Path(shutil.copy(template / "ws/.roslens/store.sqlite", copies))
        with contextlib.closing(sqlite3.connect(copy)) as connection:
            seal_all(connection, key)
            connection.commit()
        shutil.copy(copy, store)


def finished(where: Place, words: list[str]) -> str:
    """Run a command to its end and return what it said."""
    process = where.start(words)
    said, _ = process.communicate(timeout=240)
    assert process.returncode == 0, (words, process.returncode, said.decode())
    return said.decode()


def usual(template: Path, folder: Path, mount: bool) -> dict[str, Usual]:
    """Return what commands take and leave that nobody ends; what is prepared for each stays in ``template``."""
    found = {}
    with place(template, mount=False) as where:
        prepared(where)
    with place(folder, mount=mount) as where:
        copied(template, where)
        for command, words in COMMANDS.items():
            if command == "agent":
                found[command] = Usual(1.0, set())
                continue
            begun = time.monotonic()
            finished(where, words)
            found[command] = Usual(time.monotonic() - begun, where.files())
    return found


def tried(moment: Moment, template: Path, folder: Path, usually: dict[str, Usual], mount: bool) -> list[str]:
    """End a command at a moment; return what is wrong afterwards."""
    wrong: list[str] = []
    chance = random.Random(f"{moment}")
    with place(folder, mount=mount) as where:
        copied(template, where)
        before = where.files()
        _ended(where, moment, usually[moment.command].seconds, chance)
        if not wait_for(lambda: not where.processes(), ENDS_S):
            names = [Path(f"/proc/{pid}/cmdline").read_bytes()[:200] for pid in where.processes()]
            wrong.append(f"processes are left: {names}")
        if where.has_disk:
            where.empty()
        wrong += _unreadable(where)
        if moment.command == "agent":
            wrong += left(where.files(), before)
            return wrong
        said = finished(where, COMMANDS[moment.command])
        if "locked" in said or "Traceback" in said:
            wrong.append(f"the second run says {said}")
        wrong += _unreadable(where, done=moment.command)
        wrong += left(where.files(), before | usually[moment.command].files)
        if not wait_for(lambda: not where.processes(), ENDS_S):
            wrong.append("processes of the second run are left")
    return wrong


def _ended(where: Place, moment: Moment, seconds: float, chance: random.Random) -> None:
    more = {}
    if moment.way == "disk":
        room = int(200_000 * moment.share**2)
        if where.has_disk:
            where.fill(room)
        else:
            more["preexec_fn"] = lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (room, room))
    process = where.start(COMMANDS[moment.command], **more)
    try:
        process.communicate(timeout=seconds * moment.share if moment.way != "disk" else 2 * seconds + 2)
    except subprocess.TimeoutExpired:
        _end(where, process, moment.way, chance)
        try:
            process.communicate(timeout=ENDS_S)
        except subprocess.TimeoutExpired:
            # A worker that was killed may leave one that waits for it: that it is still there is what is reported.
            return


def _end(where: Place, process: subprocess.Popen[bytes], way: str, chance: random.Random) -> None:
    victims = [process.pid]
    if way == "memory":
        # The kernel ends whichever process it likes.
        victims = [chance.choice(sorted(where.processes() | {process.pid}))]
    number = signal.SIGTERM if way in ("request", "disk") else signal.SIGKILL
    for pid in victims:
        with contextlib.suppress(ProcessLookupError):
            os.kill(pid, number)
    if way == "memory" and victims != [process.pid]:
        with contextlib.suppress(subprocess.TimeoutExpired):
            process.wait(5.0)
            return
        process.terminate()


def _unreadable(where: Place, done: str = "") -> list[str]:
    """Return what cannot be read of the last run, or is not whole; ``done`` is what has run since."""
    wrong = []
    with tempfile.TemporaryDirectory() as copies:
        # SQLite follows the path of a place to where it is not.
        for path in (*(where.inside / "ws" / ".roslens").glob("*.sqlite*"), *where.inside.glob("*.sqlite*")):
            if not path.name.endswith("-shm"):
                shutil.copy(path, copies)
        with Store.open(Path(copies) / "store.sqlite", wait_s=5) as store:
            run = store.latest()
            assert run is not None
            names = {str(one.entity).partition(":")[2] for one in store.view(run).findings()}
        found = sum(name.startswith("arm/a.cpp#f") for name in names)
        if found not in ({AFTER} if done == "check" else {BEFORE, AFTER}):
            wrong.append(f"the last run has findings of {sorted(names)}")
        for path in Path(copies).glob("*.sqlite"):
            with contextlib.closing(sqlite3.connect(path)) as connection:
                if (said := connection.execute("PRAGMA integrity_check").fetchall()) != [("ok",)]:
                    wrong.append(f"{path.name}: {said}")
        with History.open(Path(copies) / "live.sqlite"):
            pass
    index = where.inside / "out" / "index.html"
    if not index.is_file() or not index.read_text("utf-8").rstrip().endswith("</html>"):
        wrong.append("the report has no whole first page")
    return wrong


def left(files: set[str], expected: set[str]) -> list[str]:
    """Return what nobody expects; databases may have the companions that SQLite gives them."""
    more = {one for one in files - expected if not one.endswith(("-wal", "-shm"))}
    return [f"left behind: {sorted(more)}"] if more else []
