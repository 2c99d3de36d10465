"""No message that was not made by who has the command key, for this host and this moment, leads to anything."""

import os
import random

import pytest

from roslens.live.agent.message_line import LineError, MessageReader, message
from roslens.live.agent.request_gate import MOST_REQUESTS, MOST_STRANGE, MOST_WRITTEN, PER_S, RequestGate, TooMuchError
from roslens.live.agent.signed_request import (
    _ENCODER,
    FRESH_S,
    MOST_BYTES,
    VERSION,
    Believing,
    Signed,
    _code,
    sign,
)
from roslens.model.acting.host_request import HostRequest

KEY, OTHER = b"k" * 32, b"o" * 32
REQUEST = HostRequest("r/1.0", "restart", "/driver", 77, (), {"grace": 2.0})


class Hand:
    def __init__(self, refusal=""):
        self.begun = []
        self.why = refusal

    def refusal(self, request):
        return self.why

    def begin(self, request):
        self.begun.append(request)


class Scene:
    def __init__(self, refusal=""):
        self.hand = Hand(refusal)
        self.written, self.refused = [], []
        self.gate = RequestGate(self.hand, self.written.append, lambda one, why: self.refused.append(why))
        self.believing = Believing("arm", KEY)
        self.number = 0

    def good(self, now):
        self.number += 1
        return sign(Signed(VERSION, "arm", self.believing.challenge(now), self.number, REQUEST), KEY)

    def take(self, content, now=0.0):
        self.gate.take(content, self.believing, now, "10.0.0.1")


def test_what_is_believed_and_allowed_is_begun_and_what_is_not_is_told():
    scene = Scene()
    scene.take(scene.good(0.0))
    assert scene.hand.begun == [REQUEST]
    scene = Scene("not on the allow-list")
    scene.take(scene.good(0.0))
    assert not scene.hand.begun
    assert scene.refused == ["not on the allow-list"]
    assert scene.written == ["`restart` of /driver for 10.0.0.1, decision r/1.0, is refused: not on the allow-list"]


def test_even_who_has_the_key_cannot_ask_too_often():
    scene = Scene()
    for _ in range(MOST_REQUESTS + 1):
        scene.take(scene.good(1.0), 1.0)
    assert len(scene.hand.begun) == MOST_REQUESTS
    assert "more than 20 requests" in scene.refused[0]
    scene.take(scene.good(1.0 + PER_S), 1.0 + PER_S)
    assert len(scene.hand.begun) == MOST_REQUESTS + 1


def test_a_flood_is_hung_up_on_and_does_not_fill_the_journal():
    scene = Scene()
    for _ in range(MOST_STRANGE - 1):
        scene.take(b"x" * 100)
    with pytest.raises(TooMuchError):
        scene.take(b"x" * 100)
    assert len(scene.written) == MOST_WRITTEN
    scene.take(b"x" * 100, PER_S)
    assert f"and {MOST_STRANGE - MOST_WRITTEN} more before it" in scene.written[-1]


KINDS = (
    "random",
    "changed",
    "cut",
    "long",
    "repeated",
    "late",
    "other key",
    "other host",
    "other line",
    "signed rubbish",
    "nonsense",
)


def forged(chance, scene, seen):
    """Return a message that must not lead to anything, of a kind by chance."""
    kind = chance.choice(KINDS)
    challenge = scene.believing.challenge(0.0)
    request = HostRequest(
        "r/9.0", chance.choice(("restart", "kill", "stop", "command")), "/driver", chance.randrange(2, 99)
    )
    good = sign(Signed(VERSION, "arm", challenge, 10**6 + chance.randrange(10**6), request), KEY)
    if kind == "random":
        return chance.randbytes(chance.randrange(300))
    if kind == "changed":
        changed = bytearray(good)
        changed[chance.randrange(len(good))] ^= chance.randrange(1, 256)
        return bytes(changed)
    if kind == "cut":
        return good[: chance.randrange(len(good))]
    if kind == "long":
        return good + chance.randbytes(chance.randrange(1, 50) if chance.random() < 0.99 else MOST_BYTES)
    if kind == "repeated":
        return seen
    if kind == "late":
        late = Believing("arm", KEY)
        late._challenges.append((challenge, -FRESH_S - 1))
        return sign(Signed(VERSION, "arm", os.urandom(16), 10**7, request), KEY)
    if kind == "other key":
        return sign(Signed(VERSION, "arm", challenge, 10**7, request), OTHER)
    if kind == "other host":
        return sign(Signed(VERSION, chance.choice(("leg", "", "ARM", "arm ")), challenge, 10**7, request), KEY)
    if kind == "other line":
        return sign(Signed(VERSION, "arm", Believing("arm", KEY).challenge(0.0), 10**7, request), KEY)
    if kind == "signed rubbish":
        body = bytearray(_ENCODER.encode(Signed(VERSION, "arm", challenge, 10**7, request)))
        del body[chance.randrange(len(body)) :]
        body += chance.randbytes(chance.randrange(4))
        return _code(OTHER if chance.random() < 0.5 else KEY, bytes(body[:-1])) + bytes(body)
    bad = HostRequest("r", chance.choice(("publish", "rm", "", "../x")), "/driver", chance.choice((-1, 1, 2**40)))
    return sign(Signed(VERSION, "arm", challenge, 10**7, bad), KEY)


def try_forged(count, seed):
    scene = Scene()
    chance = random.Random(seed)
    seen = scene.good(0.0)
    scene.take(seen)
    assert len(scene.hand.begun) == 1
    hung_up = 0
    for number in range(count):
        try:
            scene.take(forged(chance, scene, seen), now=number * 0.01 % 1.0)
        except TooMuchError:
            hung_up += 1
    assert scene.hand.begun == [REQUEST], "nothing but what was asked for by who may"
    assert hung_up > count / 2
    assert len(scene.written) <= MOST_WRITTEN + 1
    return hung_up


def test_forged_requests_lead_to_nothing():
    try_forged(3_000, 7)


@pytest.mark.nightly
def test_a_hundred_thousand_forged_requests_lead_to_nothing():
    try_forged(100_000, int.from_bytes(os.urandom(4), "big"))


def test_messages_come_through_in_any_pieces_and_rubbish_ends_the_line():
    stream = message(b"C", b"c" * 16) + message(b"D", b"")
    for size in (1, 3, 100):
        reader = MessageReader()
        found = [one for at in range(0, len(stream), size) for one in reader.feed(stream[at : at + size])]
        assert found == [(b"C", b"c" * 16), (b"D", b"")]
    for wrong in (b"\0\0\0\0", b"\xff\xff\xff\xff", b"GET / HTTP/1.1\r\n"):
        with pytest.raises(LineError):
            list(MessageReader().feed(wrong))
    chance = random.Random(3)
    for _ in range(500):
        reader = MessageReader()
        try:
            for letter, body in reader.feed(chance.randbytes(chance.randrange(200))):
                assert len(letter) == 1
                assert len(body) <= MOST_BYTES
        except LineError:
            continue
