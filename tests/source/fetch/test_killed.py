"""A fetch that is killed at any moment: what was finished is there, and the next one goes on."""

import json
import os
import random
import signal
import subprocess
import sys
from contextlib import suppress

import pytest

from roslens.cli.main import main
from roslens.intake.safe_yaml import load_yaml


@pytest.fixture
def given(server, here):
    names = [f"r{number}" for number in range(6)]
    entries = {name: {"type": "git", "url": server.package(name, commits=2)} for name in names}
    (here / "in.repos").write_text(json.dumps({"repositories": entries}))
    return ["--distribution", "in.repos", "--into", "ws", "-q"]


def killed_after(words, folder, seconds):
    """Run `roslens fetch`, end it after so long, and return whether it had ended by itself."""
    code = "import sys; from roslens.cli.main import main; sys.exit(main())"
    with subprocess.Popen(
        [sys.executable, "-c", code, "fetch", *words], cwd=folder, start_new_session=True, stderr=subprocess.DEVNULL
    ) as process:
        with suppress(subprocess.TimeoutExpired):
            return process.wait(seconds) == 0
        os.kill(process.pid, signal.SIGKILL)
    return False


def complete(here, server):
    lock = load_yaml((here / "ws/fetched.repos").read_bytes())["repositories"]
    for name, entry in lock.items():
        assert entry["version"] == server.git(here / "ws" / name, "rev-parse", "HEAD")
        assert server.git(here / "ws" / name, "status", "--porcelain") == ""
    return sorted(lock)


def test_killed_once(given, here, server):
    killed_after(given, here, 0.6)
    assert main(["fetch", *given]) == 0
    assert complete(here, server) == [f"r{number}" for number in range(6)]
    assert not list((here / "ws/.roslens/fetch").glob("parts/*"))


@pytest.mark.nightly
def test_killed_again_and_again(given, here, server):
    chance = random.Random(7)
    for _ in range(200):
        if killed_after(given, here, chance.uniform(0.2, 1.5)):
            break
        for folder in (here / "ws").glob("r*"):
            # What is in its place is whole.
            assert server.git(folder, "status", "--porcelain") == ""
    assert main(["fetch", *given]) == 0
    assert complete(here, server) == [f"r{number}" for number in range(6)]


def test_interrupted(given, here):
    code = "import sys; from roslens.cli.main import main; sys.exit(main())"
    with subprocess.Popen([sys.executable, "-c", code, "fetch", *given], cwd=here, start_new_session=True) as process:
        while not (here / "ws/.roslens/fetch/busy").exists() and process.poll() is None:
            pass
        process.send_signal(signal.SIGINT)
        assert process.wait(20) in (130, 0)
