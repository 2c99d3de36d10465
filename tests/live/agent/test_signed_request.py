import msgspec
import pytest

from roslens.live.agent.signed_request import (
    CODE_BYTES,
    FRESH_S,
    MOST_BYTES,
    VERSION,
    Believing,
    RefusedError,
    Signed,
    _code,
    sign,
)
from roslens.model.acting.host_request import HostRequest

KEY, OTHER = b"k" * 32, b"o" * 32
REQUEST = HostRequest("r/1.0", "restart", "/driver", 77, ("/b",), {"grace": 2.0})


@pytest.fixture
def believing():
    return Believing("arm", KEY)


def signed(challenge, number=0, request=REQUEST, host="arm", version=VERSION, key=KEY):
    return sign(Signed(version, host, challenge, number, request), key)


def refused(believing, message, now=0.0):
    with pytest.raises(RefusedError) as caught:
        believing.believed(message, now)
    return str(caught.value)


def test_what_is_signed_for_this_host_and_fresh_is_believed(believing):
    challenge = believing.challenge(0.0)
    assert believing.believed(signed(challenge), FRESH_S) == REQUEST
    assert believing.believed(signed(challenge, 1), 1.0) == REQUEST
    assert believing.believed(signed(believing.challenge(5.0), 9), 5.0) == REQUEST


def test_what_was_heard_before_is_not_done_again(believing):
    challenge = believing.challenge(0.0)
    message = signed(challenge, 3)
    believing.believed(message, 0.0)
    assert "repeated" in refused(believing, message)
    assert "repeated" in refused(believing, signed(challenge, 2))


def test_what_was_held_up_is_not_done_later(believing):
    message = signed(believing.challenge(0.0))
    assert "a challenge of 3.1 s ago" in refused(believing, message, FRESH_S + 0.1)


def test_what_was_heard_on_another_connection_or_host_is_not_done_here(believing):
    other = Believing("arm", KEY)
    assert "no challenge of this connection" in refused(believing, signed(other.challenge(0.0)))
    assert "meant for 'leg'" in refused(believing, signed(believing.challenge(0.0), host="leg"))
    assert "not signed" in refused(believing, signed(believing.challenge(0.0), key=OTHER))


def test_every_changed_byte_is_noticed(believing):
    message = signed(believing.challenge(0.0))
    for place in range(len(message)):
        changed = bytearray(message)
        changed[place] ^= 1
        assert "not signed" in refused(believing, bytes(changed))
    assert believing.believed(message, 0.0) == REQUEST


@pytest.mark.parametrize(
    ("request_", "why"),
    [
        (HostRequest("r", "publish", "/n", 7), "nothing that a host does"),
        (HostRequest("r", "stop", "/n", 1), "1 is not a process"),
        (HostRequest("r", "stop", "/n", -7), "not a process"),
        (HostRequest("r", "stop", "/n\n", 7), "names"),
        (HostRequest("r", "stop", "/n", 7, ("/a",) * 2000), "names"),
        (HostRequest("r", "stop", "/n", 7, (), {"shell": "rm"}), "no argument 'shell'"),
    ],
)
def test_what_makes_no_sense_is_refused_whoever_signs_it(believing, request_, why):
    assert why in refused(believing, signed(believing.challenge(0.0), request=request_))


def test_what_is_no_request_is_refused_whoever_signs_it(believing):
    for body in (b"", b"\x90", msgspec.msgpack.encode([1, 2, 3]), b"\xdd\xff\xff\xff\xff", b"\x91" * 5000):
        assert refused(believing, _code(KEY, body) + body)
    assert "bytes, expected" in refused(believing, b"x" * (MOST_BYTES + 1))
    assert "bytes, expected" in refused(believing, b"x" * CODE_BYTES)
    assert "version 2" in refused(believing, signed(believing.challenge(0.0), version=2))


def test_a_request_that_is_too_long_is_not_sent():
    with pytest.raises(RefusedError, match="bytes"):
        signed(b"c" * 16, request=HostRequest("r", "stop", "/n" * MOST_BYTES, 7))
