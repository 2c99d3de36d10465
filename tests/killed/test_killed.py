"""Whenever and however a command ends, the last run can be read, nothing is left behind, and the next run is right."""

import os
import random
import subprocess
import sys

import pytest

from killed.place import MARK, may_mount, place, wait_for
from killed.trial import COMMANDS, WAYS, drawn, left, tried, usual

pytestmark = [pytest.mark.heavy, pytest.mark.timed]

FEW = 5
SEED = 12
MANY = 200


@pytest.fixture(scope="module")
def mount():
    return may_mount()


@pytest.fixture(scope="module")
def template(tmp_path_factory):
    return tmp_path_factory.mktemp("killed") / "template"


@pytest.fixture(scope="module")
def usually(template, mount):
    return usual(template, template.with_name("usual"), mount)


def test_every_way_and_command_is_among_the_moments():
    moments = drawn(FEW, SEED)
    assert {one.command for one in moments} == set(COMMANDS)
    assert {one.way for one in moments} == set(WAYS)
    assert len({(one.command, one.way) for one in drawn(16, SEED)}) == 16


def test_what_is_left_is_seen(tmp_path):
    """A process that took leave of its parent and session, and a file, are reported; those of others are not."""
    code = "import os, time\nos.fork() and os._exit(0)\nos.setsid()\ntime.sleep(100)"
    with place(tmp_path / "place", mount=False) as where:
        assert not where.processes()
        before = where.files()
        environment = {**os.environ, MARK: where.mark}
        subprocess.run([sys.executable, "-S", "-c", code], env=environment, check=True)
        assert wait_for(lambda: len(where.processes()) == 1, 10)
        (where.inside / ".out.1.partial").mkdir()
        assert left(where.files(), before) == ["left behind: ['.out.1.partial']"]
    assert wait_for(lambda: not where.processes(), 10)


def test_commands_that_are_ended_at_a_few_moments(tmp_path, template, usually, mount):
    wrong = []
    for number, moment in enumerate(drawn(FEW, SEED)):
        wrong += [(moment, one) for one in tried(moment, template, tmp_path / str(number), usually, mount)]
    assert wrong == []


@pytest.mark.nightly
@pytest.mark.timeout(4 * 3600)
def test_commands_that_are_ended_at_two_hundred_moments(tmp_path, template, usually, mount):
    seed = random.SystemRandom().randrange(10**9)
    wrong = []
    for number, moment in enumerate(drawn(int(os.environ.get("ROSLENS_MOMENTS", MANY)), seed)):
        wrong += [(moment, one) for one in tried(moment, template, tmp_path / str(number), usually, mount)]
    assert wrong == [], f"seed {seed}"
