"""Functions of a module that processes can import, which read files that end their process."""

import os
import sys
import textwrap
import time

import pytest

READING = """
import os
import signal
import threading
import time
from pathlib import Path

from roslens.intake.file_budget import file_budget, memory_of_file, refused
from roslens.intake.time_budget import OverBudgetError
from roslens.model.errors import DocumentError


def read(root, *names):
    found = {}
    for name in names:
        text = Path(root, name).read_text()
        try:
            with file_budget(name, seconds=1.0):
                if text == "abort":
                    os.abort()
                if text == "spin":
                    # As a call into C that looks at nothing.
                    signal.pthread_sigmask(signal.SIG_BLOCK, set(range(1, 65)) - {signal.SIGXCPU})
                    while True:
                        pass
                if text == "slow":
                    while True:
                        pass
                if text == "large":
                    bytearray(8_000_000_000)
                found[name] = text
        except OverBudgetError as error:
            found[name] = f"left out: {error}"
    return os.getpid(), found


def told(tell, times):
    for number in range(times):
        tell("step", number)
    return times


def wrong(path):
    raise DocumentError("a key", where=path, expected="none")


def lost():
    os._exit(7)


def lost_once(mark):
    if not Path(mark).exists():
        Path(mark).touch()
        os._exit(7)
    return "found"


def printed():
    print("not an answer")
    return sorted(refused())


def memory():
    return memory_of_file()


def read_all(task):
    return read(*task)


def run(task):
    function, *given = task
    return globals()[function](*given)
"""


@pytest.fixture
def reading(tmp_path, monkeypatch):
    (tmp_path / "reading_of_files.py").write_text(textwrap.dedent(READING))
    monkeypatch.syspath_prepend(tmp_path)
    import reading_of_files

    yield reading_of_files
    del sys.modules["reading_of_files"]


@pytest.fixture
def written(tmp_path):
    """Give what writes files with these texts that have not changed for a while."""

    def write(**texts):
        past = time.time() - 60
        for name, text in texts.items():
            (tmp_path / name).write_text(text)
            os.utime(tmp_path / name, (past, past))

    return write
