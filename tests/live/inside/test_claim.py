"""What the hook in Python says it counts, for the preloaded library to leave to it."""

import os

import pytest

from roslens.live.inside.rclpy_state import CLAIM, Hook


@pytest.fixture
def hook(monkeypatch, tmp_path):
    monkeypatch.setenv("ROSLENS_COUNTERS", str(tmp_path))
    monkeypatch.delenv(CLAIM, raising=False)
    hook = Hook()
    yield hook
    hook.close()
    os.environ.pop(CLAIM, None)


def test_each_direction_is_claimed_for_this_process(hook):
    hook.claim("published")
    assert os.environ[CLAIM] == f"{os.getpid()} published"
    hook.claim("taken")
    assert os.environ[CLAIM] == f"{os.getpid()} published taken"


def test_after_an_error_nothing_is_claimed(hook):
    hook.claim("taken")
    hook.stop(ValueError("broken"))
    assert CLAIM not in os.environ


def test_a_child_that_counts_on_claims_for_itself(hook, monkeypatch):
    hook.claim("taken")
    monkeypatch.setattr(os, "getpid", lambda: 4711)
    hook.after_fork()
    assert os.environ[CLAIM] == "4711 taken"


def test_a_child_of_one_that_counted_claims_nothing(hook):
    hook.claim("taken")
    hook.slot(1, b"", "/t", "/n")
    hook.after_fork()
    assert CLAIM not in os.environ
