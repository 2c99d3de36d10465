"""Mutated files and frames: each is answered, in time, without a crash."""

import os
import random
import subprocess
import sys

import pytest
from pace import slowness

from fuzz.kinds import KINDS, words_of
from fuzz.mutator import MOST_BYTES, mutated
from fuzz.runner import LONGEST_S, Failed, cases, kept, run, shrunk, why_it_fails

CASES = 50
"""In passing; each night there are a hundred thousand, new each time."""
NIGHTLY_CASES = int(os.environ.get("ROSLENS_FUZZ_CASES", "100000"))


@pytest.mark.parametrize("name", KINDS)
def test_what_failed_once_is_answered(name):
    for path in kept(name):
        assert not why_it_fails(KINDS[name], path.read_bytes(), LONGEST_S * slowness()), path


@pytest.mark.parametrize("name", KINDS)
def test_mutated_input_is_answered(name):
    assert KINDS[name].seeds()
    for content in cases(name, 0, CASES, 1e9):
        assert not why_it_fails(KINDS[name], content, LONGEST_S * slowness()), content


@pytest.mark.nightly
@pytest.mark.heavy
@pytest.mark.timeout(4 * 3600)
@pytest.mark.parametrize("name", KINDS)
def test_a_hundred_thousand_cases_are_answered(name):
    seed = str(random.SystemRandom().randrange(10**9))
    command = [sys.executable, "-m", "fuzz", name, "--cases", str(NIGHTLY_CASES), "--seed", seed]
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(filter(None, sys.path))}
    done = subprocess.run(command, capture_output=True, text=True, env=environment, check=False)
    assert done.returncode == 0, done.stdout + done.stderr


def test_cases_differ_and_are_the_same_again():
    first, again = (list(cases("yaml", 7, 20, 1e9)) for _ in range(2))
    assert first == again
    assert len(set(first)) > 15
    assert max(map(len, first)) <= MOST_BYTES
    assert all(words_of(kind) for kind in KINDS.values())


def test_each_way_to_fail_is_noticed(monkeypatch):
    """A reader that raises, one that does not end, one that crashes: all are failures with their case."""

    def read(content):
        if b"x" in content:
            raise KeyError("x")
        if b"s" in content:
            os.kill(os.getpid(), 11)
        while b"l" in content:
            pass

    kind = KINDS["yaml"]._replace(seeds=lambda: [b"a"], words="", read=read)
    assert "KeyError" in why_it_fails(kind, b"x", 1.0)
    assert "more than 0 s of a processor for 1 bytes" in why_it_fails(kind, b"l", 0.05)
    assert why_it_fails(kind, b"a", 1.0) == ""
    for case, why in ((b"x", "KeyError"), (b"s", "SIGSEGV")):
        monkeypatch.setitem(KINDS, "yaml", kind)
        monkeypatch.setattr("fuzz.runner.mutated", lambda chance, seeds, words, case=case: case)
        _, failed = run("yaml", 1, 1)
        assert [type(one) for one in failed] == [Failed]
        assert (failed[0].content, why in failed[0].why) == (case, True)


def test_a_case_is_made_shorter():
    assert shrunk(b"aaaaaaaxaaaayaaa", lambda case: b"x" in case and b"y" in case) == b"xy"
    assert mutated(random.Random(1), [b""], [b"a"]) is not None
