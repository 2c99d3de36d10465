"""Domains for tests: below those that share their ports with everybody, and free."""

import socket
from contextlib import ExitStack

from ros2_domain import FIRST, LAST, own_domain


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
