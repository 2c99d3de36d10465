"""A fetch ends within two seconds of Ctrl-C or a request to end, at whatever moment that comes."""

import json
import os
import random
import shutil
import signal
import socket
import subprocess
import sys
import time
from contextlib import suppress
from pathlib import Path
from uuid import uuid4

import pytest
from pace import slowness

MOST_S = 2.0
"""On an idle machine, until the process and all that it started are gone."""
MOMENTS, ALL_MOMENTS = 4, 300
START = "import sys; from roslens.cli.main import main; sys.exit(main())"


@pytest.fixture
def given(server, here):
    """Repositories of a folder, and one of a server that refuses every connection: it is asked again after pauses."""
    entries = {f"r{number}": {"type": "git", "url": server.package(f"r{number}", commits=2)} for number in range(8)}
    with socket.socket() as refused:
        refused.bind(("127.0.0.1", 0))
        entries["refused"] = {"type": "git", "url": f"http://127.0.0.1:{refused.getsockname()[1]}/a", "version": "main"}
        (here / "in.repos").write_text(json.dumps({"repositories": entries}))
        yield ["fetch", "--distribution", "in.repos", "--into", "ws", "-q"]


def marked(mark):
    """Return what still runs of all that was started with a variable in its environment."""
    found = []
    for place in Path("/proc").glob("[0-9]*/environ"):
        # A process that is gone, or only waited for, has none.
        with suppress(OSError):
            if mark.encode() in place.read_bytes():
                found.append(int(place.parent.name))
    return found


def ended_after(words, here, delay_s, number):
    """Return how long a fetch that is at it for so long takes to end, and its exit code; None if it had ended."""
    shutil.rmtree(here / "ws", ignore_errors=True)
    mark = f"ROSLENS_TEST_MARK={uuid4().hex}"
    with subprocess.Popen(
        [sys.executable, "-c", START, *words],
        cwd=here,
        stderr=subprocess.PIPE,
        text=True,
        env={**os.environ, **dict([mark.split("=")])},
    ) as process:
        # Until Python handles signals as roslens does, they end it at once.
        while not (here / "ws/.roslens").exists():
            with suppress(subprocess.TimeoutExpired):
                process.wait(0.02)
        try:
            process.wait(delay_s)
        except subprocess.TimeoutExpired:
            pass
        else:
            return None
        begun = time.monotonic()
        process.send_signal(number)
        code, errors = process.wait(60), process.stderr.read()
        while left := marked(mark):
            assert time.monotonic() - begun < 60, left
        assert "Traceback" not in errors
        return time.monotonic() - begun, code


def some_moments(words, here, many, seed):
    chance = random.Random(seed)
    took = []
    for turn in range(many):
        found = ended_after(words, here, chance.uniform(0, 3), (signal.SIGINT, signal.SIGTERM)[turn % 2])
        assert found is not None, "it waits for the server that refuses"
        assert found[1] == 130
        took.append(found[0])
    return took


@pytest.mark.timed
def test_it_ends_at_some_moments(given, here):
    assert max(some_moments(given, here, MOMENTS, 3)) < MOST_S * slowness()


@pytest.mark.nightly
@pytest.mark.heavy
@pytest.mark.timeout(3600)
def test_it_ends_at_every_moment(given, here):
    took = some_moments(given, here, ALL_MOMENTS, random.SystemRandom().random())
    assert max(took) < MOST_S * slowness(), sorted(took)[-5:]
