"""A fetch ends within two seconds of Ctrl-C or a request to end, at whatever moment that comes.

Moments are numbers of what the process does (`scripted_end.py`), so the same come again; how those of a clock fare,
which also fall into what one call of the system takes, is tried each night.
"""

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
SCRIPT = Path(__file__).with_name("scripted_end.py")
START = "import sys; from roslens.cli.main import main; sys.exit(main())"


@pytest.fixture
def given(server, here):
    """Repositories of a folder, and one of a server that refuses every connection: it is asked again after pauses."""
    entries = {f"r{number}": {"type": "git", "url": server.package(f"r{number}", commits=2)} for number in range(8)}
    (here / "good.repos").write_text(json.dumps({"repositories": entries}))
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


def begun(words, here, moment, number, mark=""):
    """Begin a fetch that is sent a signal at a moment."""
    shutil.rmtree(here / "ws", ignore_errors=True)
    return subprocess.Popen(
        [sys.executable, str(SCRIPT), str(moment), str(int(number)), *words],
        cwd=here, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
        env={**os.environ, **dict([mark.split("=")] if mark else [])},
    )  # fmt: skip


def scripted(words, here, many):
    """Return how long a fetch takes to end at each of so many moments, evenly over all that it has."""
    good = [word.replace("in.repos", "good.repos") for word in words]
    with begun(good, here, 0, 0) as process:
        said, errors = process.communicate(timeout=120)
    assert process.returncode == 0, errors
    moments = int(said)
    assert moments > many
    took = []
    for turn in range(many):
        mark = f"ROSLENS_TEST_MARK={uuid4().hex}"
        moment = 1 + turn * (moments - 1) // max(many - 1, 1)
        with begun(words, here, moment, (signal.SIGINT, signal.SIGTERM)[turn % 2], mark) as process:
            since, errors = process.communicate(timeout=120)
        while left := marked(mark):
            assert time.monotonic() - float(since) < 60, left
        took.append(time.monotonic() - float(since))
        assert process.returncode == 130, (moment, errors)
        assert "Traceback" not in errors, (moment, errors)
    return took


@pytest.mark.timed
def test_it_ends_at_scripted_moments(given, here):
    assert max(scripted(given, here, MOMENTS)) < MOST_S * slowness()


@pytest.mark.nightly
@pytest.mark.heavy
@pytest.mark.timed
@pytest.mark.timeout(3600)
def test_it_ends_at_each_of_many_scripted_moments(given, here):
    took = sorted(scripted(given, here, ALL_MOMENTS))
    sys.stdout.write(f"{len(took)} moments: median {took[len(took) // 2]:.2f} s, longest {took[-1]:.2f} s\n")
    assert took[-1] < MOST_S * slowness(), took[-5:]


@pytest.mark.timed
def test_it_ends_at_a_moment_of_the_clock(given, here):
    assert max(some_moments(given, here, 1, 3)) < MOST_S * slowness()


@pytest.mark.nightly
@pytest.mark.heavy
@pytest.mark.timeout(3600)
def test_it_ends_at_many_moments_of_the_clock(given, here):
    took = some_moments(given, here, ALL_MOMENTS, random.SystemRandom().random())
    took.sort()
    sys.stdout.write(f"{len(took)} moments: median {took[len(took) // 2]:.2f} s, longest {took[-1]:.2f} s\n")
    assert took[-1] < MOST_S * slowness(), took[-5:]
