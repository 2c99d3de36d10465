"""Domains for tests: below those that share their ports with everybody, and free."""

import os
import socket
import time
from contextlib import ExitStack

import pytest
import ros2_domain
from ros2_domain import CLAIMED_S, FIRST, LAST, own_domain


@pytest.fixture(autouse=True)
def claims(tmp_path, monkeypatch):
    """No claims of other runs on this machine."""
    monkeypatch.setattr(ros2_domain, "_CLAIMS", tmp_path)
    return tmp_path


def test_each_call_gets_another_one_whose_ports_nobody_else_is_given():
    found = [int(own_domain()) for _ in range(5)]
    assert len(set(found)) == 5
    assert all(FIRST <= domain <= LAST for domain in found)
    assert 7400 + 250 * (LAST + 1) < 32768


def test_one_in_which_somebody_listens_is_passed_over():
    with ExitStack() as stack:
        expected = int(own_domain())
        for _ in range(3):
            expected = FIRST + (expected + 1 - FIRST) % (LAST + 1 - FIRST)
            taken = stack.enter_context(socket.socket(socket.AF_INET, socket.SOCK_DGRAM))
            taken.bind(("127.0.0.1", 7400 + 250 * expected + 41))
            found = int(own_domain())
            assert found != expected
            expected = found


def test_one_that_was_just_given_to_another_process_is_passed_over(claims):
    own = int(own_domain())
    following, after = (FIRST + (own + more - FIRST) % (LAST + 1 - FIRST) for more in (1, 2))
    for domain in (following, after):
        (claims / str(domain)).write_text("1")
    os.utime(claims / str(after), (time.time() - CLAIMED_S - 1,) * 2)
    assert int(own_domain()) == after
