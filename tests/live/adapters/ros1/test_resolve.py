import threading

import pytest

from roslens.live.adapters.ros1.resolve import AGAIN_S, FRESH_S, Resolver, UnresolvedError

pytestmark = pytest.mark.timed


def test_an_answer_is_remembered_and_grows_old():
    now, asked = [0.0], []

    def ask(host):
        asked.append(host)
        return f"10.0.0.{len(asked)}"

    resolver = Resolver(ask, clock=lambda: now[0])
    assert resolver.address("robot") == resolver.address("robot") == "10.0.0.1"
    now[0] = FRESH_S + 1
    assert resolver.address("robot") == "10.0.0.2"


def test_a_refusal_is_remembered_for_a_while():
    now, asked = [0.0], []

    def ask(host):
        asked.append(host)
        raise OSError("Name or service not known")

    resolver = Resolver(ask, clock=lambda: now[0])
    for _ in range(2):
        with pytest.raises(UnresolvedError, match="'robot' is not known here: Name or service"):
            resolver.address("robot")
    assert len(asked) == 1
    now[0] = AGAIN_S + 1
    with pytest.raises(UnresolvedError):
        resolver.address("robot")
    assert len(asked) == 2


def test_a_name_server_that_hangs_does_not_hang_us_and_its_late_answer_counts():
    gate, late = threading.Event(), threading.Event()

    def ask(host):
        gate.wait(5)
        return "10.0.0.9"

    resolver = Resolver(ask, wait_s=0.01)
    with pytest.raises(UnresolvedError, match="no name server gave"):
        resolver.address("robot")
    gate.set()
    for _ in range(500):
        try:
            assert resolver.address("robot") == "10.0.0.9"
            break
        except UnresolvedError:
            late.wait(0.01)
    else:
        pytest.fail("the late answer never came")


@pytest.mark.parametrize("host", ["", "x" * 300])
def test_what_is_no_name_is_not_asked_for(host):
    with pytest.raises(UnresolvedError, match="not a host name"):
        Resolver(lambda host: "1.2.3.4").address(host)


def test_the_local_host_is_found():
    assert Resolver().address("127.0.0.1") == "127.0.0.1"
