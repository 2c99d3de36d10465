"""What the type of a message tells the library: how long it is, and when it was stamped; and what a message answers."""

import pytest
from native.series import series

from roslens.live.inside.slots import ANSWERED, PUBLISHED, TAKEN
from roslens.live.inside.snapshot import snapshot

SECOND = 1_000_000_000
START = 1_700_000_000 * SECOND
GID = "11" * 16


def counted(node):
    found = [snapshot(memoryview(raw)) for raw in node.slots()]
    return {(one.kind, one.topic, one.other): one for one in found}


def message(number, received=START + 1000):
    return f"message {received - 500} {received} {number} {GID}"


IMAGES = ["humble_image", "jazzy_image", "lyrical_image"]
"""As each release describes it; Kilted describes it as Jazzy does."""


@pytest.mark.parametrize("word", ["header", "jazzy", "cpp", "string", *IMAGES, "lyrical_buffer"])
def test_messages_have_the_size_that_their_type_tells(either, word):
    """And the four bytes in front of each."""
    node = either()
    node.say(f"publisher /scan / laser {word}", f"subscription /scan / map {word}", "set size 96")
    node.say(*["publish 0 typed"] * 3, message(1), "take 1 info", message(2), "take 1 loaned_info", "publish 0 loaned")
    found = counted(node)
    assert (found[PUBLISHED, "/scan", ""].messages, found[PUBLISHED, "/scan", ""].size) == (4, 400)
    assert (found[TAKEN, "/scan", ""].messages, found[TAKEN, "/scan", ""].size) == (2, 200)


@pytest.mark.parametrize(
    ("word", "stamped"),
    [("header", 2), ("jazzy", 2), ("cpp", 2), ("headers", 0), ("string", 0), ("bare", 0), ("lyrical_buffer", 0)]
    + [(word, 2) for word in IMAGES],
)
def test_messages_that_begin_with_a_header_have_an_age(either, word, stamped):
    node = either()
    node.say(f"subscription /scan / map {word}", "set stamp 1699999990")
    for number in (1, 2):
        node.say(message(number), "take 0 info")
    node.say("set stamp 0", message(3), "take 0 info")
    (one,) = counted(node).values()
    count, total, _ = series(one)[2]
    assert (one.messages, count) == (3, stamped)
    assert total == pytest.approx(stamped * 10.000000750)


def test_a_type_that_supports_nothing_leaves_no_error_behind(either):
    node = either()
    node.say(
        "publisher /scan / laser bare", "subscription /scan / map bare", "publish 0 typed", message(1), "take 1 info"
    )
    assert node.say("asked") == [0]
    assert [one.size for one in counted(node).values()] == [-1, -1]


def answering(either):
    node = either()
    assert node.say("library roslens_count_answers") == [0]
    node.say("subscription /in / relay", "subscription /too / relay", "publisher /out / relay", "service /s / relay")
    return node


def take_and_publish(node, since, after, subscription=0):
    node.say(message(1), f"time {since}", f"take {subscription} info", f"time {since + after}", "publish 2 typed")


def test_what_is_published_where_a_message_was_taken_answers_it(either):
    node = answering(either)
    for number in range(3):
        take_and_publish(node, START + number * SECOND, 2_000_000)
    take_and_publish(node, START + 5 * SECOND, 7_000_000, subscription=1)
    found = counted(node)
    one, other = found[ANSWERED, "/out", "/in"], found[ANSWERED, "/out", "/too"]
    assert (one.messages, one.node, one.gid, one.size, one.lost) == (3, "/relay", bytes(24), -1, -1)
    assert series(one)[3] == pytest.approx((3, 0.006, 3 * 0.002**2))
    assert [count for count, _, _ in series(one)[:3]] == [0, 0, 0]
    assert series(other)[3] == pytest.approx((1, 0.007, 0.007**2))
    assert found[PUBLISHED, "/out", ""].messages == 4


@pytest.mark.parametrize("else_done", ["library roslens_forget_taken", "serve 3 ask", "destroy 0"])
def test_what_is_published_after_something_else_answers_nothing(either, else_done):
    node = answering(either)
    node.say(message(1), "take 0 info", else_done, "publish 2 typed")
    assert (ANSWERED, "/out", "/in") not in counted(node)


def test_where_nobody_tells_what_else_is_done_nothing_is_an_answer(either):
    node = either()
    node.say("subscription /in / relay", "publisher /out / relay", message(1), "take 0 info", "publish 1 typed")
    assert {kind for kind, _, _ in counted(node)} == {TAKEN, PUBLISHED}


def test_a_clock_that_is_set_back_makes_no_answer(either):
    node = answering(either)
    take_and_publish(node, START, -SECOND)
    assert (ANSWERED, "/out", "/in") not in counted(node)
