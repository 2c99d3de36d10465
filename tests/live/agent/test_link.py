import hmac
import random
import struct

import msgspec
import pytest

from roslens.live.agent.link import (
    LINK_VERSION,
    Channel,
    LinkError,
    Outbox,
    asked_time,
    frame_body,
    named_pids,
    read_frame,
    read_pids,
    read_times,
    reported_time,
)
from roslens.model.entity import EntityId, EntityKind
from roslens.model.traffic.sample import Sample
from roslens.model.wire import VERSION, Frame

KEY = b"a key of more than sixteen bytes"


def frame(number=0, samples=1):
    entity = EntityId(EntityKind.HOST, "base")
    return Frame(VERSION, "base/agent", number, 1.0, samples=[Sample(entity, 1.0, {"cpu": 5.0})] * samples)


def joined(agent_key=KEY, monitor_key=KEY):
    """Shake hands; returns both sides."""
    agent, monitor = Channel(agent_key, accepting=False), Channel(monitor_key, accepting=True)
    to_monitor, to_agent = agent.hello(), monitor.hello()
    while to_monitor or to_agent:
        said = b"".join(body for kind, body in monitor.feed(to_monitor) if kind == "send")
        to_monitor = b"".join(body for kind, body in agent.feed(to_agent) if kind == "send")
        to_agent = said
    return agent, monitor


def test_both_prove_the_key_then_frames_go():
    agent, monitor = joined()
    assert agent.ready
    assert monitor.ready
    sent = agent.message("F", frame_body(frame(1))) + agent.message("F", frame_body(frame(2)))
    got = [read_frame(body) for at in range(0, len(sent), 7) for _, body in monitor.feed(sent[at : at + 7])]
    assert got == [frame(1), frame(2)]


def test_another_key_is_told():
    with pytest.raises(LinkError, match="does not know the key: give both the same --key-file"):
        joined(monitor_key=b"another key of thirty-two bytes.")


def test_nothing_is_taken_before_the_handshake():
    monitor = Channel(KEY, accepting=True)
    agent, _ = joined()
    with pytest.raises(LinkError, match="a message of"):
        list(monitor.feed(agent.message("F", frame_body(frame()))))
    with pytest.raises(LinkError, match="before the handshake"):
        Channel(KEY, accepting=False).message("F", b"")


def test_changed_repeated_or_left_out():
    for change in ("flip", "repeat", "leave out"):
        agent, monitor = joined()
        first, second = agent.message("F", frame_body(frame(1))), agent.message("F", frame_body(frame(2)))
        if change == "flip":
            first = first[:20] + bytes([first[20] ^ 1]) + first[21:]
        stream = {"flip": first, "repeat": first + first, "leave out": second}[change]
        with pytest.raises(LinkError, match="changed, repeated or left out"):
            list(monitor.feed(stream))


def test_what_we_say_ourselves_does_not_prove_anything():
    one = Channel(KEY, accepting=True)
    with pytest.raises(LinkError, match="our own greeting"):
        list(one.feed(one.hello()))
    other = Channel(KEY, accepting=True)
    assert list(one.feed(other.hello())) == []
    list(other.feed(one.hello()))
    with pytest.raises(LinkError, match="does not know the key"):
        list(other.feed(one._answer()))


def test_nobody_is_told_anything_that_says_back_what_it_hears():
    """A stranger between an agent and itself, or between two agents, or two monitors, gets no line."""
    for accepting in (False, True):
        one, other = Channel(KEY, accepting=accepting), Channel(KEY, accepting=accepting)
        said = [*one.feed(other.hello()), *other.feed(one.hello())]
        answers = [body for kind, body in said if kind == "send"]
        assert bool(answers) is not accepting  # a monitor proves nothing to who has proven nothing
        for side in (one, other):
            for answer in answers:
                with pytest.raises(LinkError, match="does not know the key"):
                    list(side.feed(answer))
        assert not one.ready
        assert not other.ready


def test_a_message_that_comes_back_is_refused():
    agent, monitor = joined()
    for side, body in ((agent, frame_body(frame())), (monitor, named_pids({1}))):
        with pytest.raises(LinkError, match="whose code is wrong"):
            list(side.feed(side.message("F", body)))


def bodies(stream):
    """Cut what was sent into its messages."""
    found = []
    while stream:
        (length,) = struct.unpack(">I", stream[:4])
        found.append(stream[4 : 4 + length])
        stream = stream[4 + length :]
    return found


def test_version_and_roles_are_in_the_proof():
    """The proofs as the description of the protocol has them, made here by hand."""
    agent, monitor = Channel(KEY, accepting=False, nonce=b"a" * 16), Channel(KEY, accepting=True, nonce=b"m" * 16)
    version = bytes([LINK_VERSION])
    said = b"roslens link agent" + version + b"a" * 16 + b"monitor" + version + b"m" * 16
    session = hmac.digest(KEY, said, "sha256")
    ((_, proof),) = agent.feed(monitor.hello())
    assert bodies(proof) == [b"A" + hmac.digest(session, b"proof of agent", "sha256")]
    assert list(monitor.feed(agent.hello())) == []
    (_, answer), ready = monitor.feed(proof)
    assert ready == ("ready", b"")
    assert bodies(answer) == [b"A" + hmac.digest(session, b"proof of monitor", "sha256")]


def test_a_greeting_that_was_changed_on_the_way_ends_the_line(monkeypatch):
    """Both sides speak another version, and somebody makes each believe that the other one speaks its own."""
    agent, monitor = Channel(KEY, accepting=False), Channel(KEY, accepting=True)
    monkeypatch.setattr("roslens.live.agent.link.LINK_VERSION", LINK_VERSION + 1)
    newer = agent.hello()
    ((_, proof),) = agent.feed(monitor.hello())
    monkeypatch.undo()
    list(monitor.feed(newer[:5] + bytes([LINK_VERSION]) + newer[6:]))
    with pytest.raises(LinkError, match="does not know the key"):
        list(monitor.feed(proof))


def test_a_monitor_with_several_keys_knows_which_one_is_meant():
    others = [bytes([number]) * 32 for number in range(3)]
    for number, key in enumerate(others):
        agent, monitor = Channel(key, accepting=False), Channel(*others, accepting=True)
        list(monitor.feed(agent.hello()))
        ((_, proof),) = agent.feed(monitor.hello())
        answers = [body for kind, body in monitor.feed(proof) if kind == "send"]
        list(agent.feed(b"".join(answers)))
        assert (monitor.key, agent.key, agent.ready) == (number, 0, True)
    with pytest.raises(LinkError, match="2 keys, expected at most 1"):
        Channel(*others[:2], accepting=False)
    with pytest.raises(LinkError, match="65 keys, expected at most 64"):
        Channel(*others[:1] * 65, accepting=True)


def test_another_version_and_another_program():
    hello = bytearray(Channel(KEY, accepting=False).hello())
    hello[5] = 9
    with pytest.raises(LinkError, match="speaks version 9, expected 3"):
        list(Channel(KEY, accepting=True).feed(bytes(hello)))
    with pytest.raises(LinkError, match="expected a roslens agent"):
        list(Channel(KEY, accepting=True).feed(b"GET / HTTP/1.1\r\n\r\n"))


def test_a_short_key_is_refused():
    with pytest.raises(LinkError, match="a key of 5 bytes, expected at least 32"):
        Channel(b"short", accepting=True)


def test_times():
    assert read_times(reported_time(asked_time(1.5), 2.0, 3.0)) == (1.5, 2.0, 3.0)
    with pytest.raises(LinkError, match="expected 8"):
        reported_time(b"x", 1.0, 2.0)
    with pytest.raises(LinkError, match="expected 24"):
        read_times(b"x")


def test_pids():
    assert read_pids(named_pids({5, 3})) == [3, 5]
    with pytest.raises(LinkError, match="not process ids"):
        read_pids(b"\xc1")


def test_an_outbox_is_bounded_and_says_what_it_gave_up():
    outbox = Outbox(most_frames=3)
    for number in range(5):
        outbox.put(frame(number, samples=2))
    outbox.put(frame(5))
    frames = [read_frame(body) for body in iter(outbox.take, None)]
    assert [one.sequence for one in frames] == [3, 4, 5]
    # Frame 0 was given up before 4 came, 1 before 5; that 2 went, the next frame tells.
    assert [one.shed for one in frames] == [0, 2, 2]
    outbox.put(frame(6))
    assert read_frame(outbox.take()).shed == 2


def test_an_outbox_of_large_frames():
    outbox = Outbox(most_bytes=1_000)
    for number in range(100):
        outbox.put(frame(number, samples=5))
    assert 0 < len(outbox) < 20


def test_garbage_is_named_and_nothing_else():
    rng = random.Random(7)
    for _ in range(3_000):
        monitor = Channel(KEY, accepting=True)
        piece = bytes(rng.randrange(256) for _ in range(rng.randrange(60)))
        if rng.random() < 0.5:
            piece = len(piece).to_bytes(4, "big") + piece
        try:
            list(monitor.feed(piece))
        except LinkError as error:
            assert str(error)  # noqa: PT017 - every message is fine, a crash is not
        assert not monitor.ready


def test_frames_that_are_no_frames():
    with pytest.raises(LinkError, match="not a frame"):
        read_frame(b"\xc1")
    with pytest.raises(LinkError, match="version 7"):
        read_frame(frame_body(msgspec.structs.replace(frame(), version=7)))
