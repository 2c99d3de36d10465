"""What is seen by all readers together, and when that is everything."""

import pytest

from roslens.dashboard.live.sight import LASTING_S, MOST_ROWS, NOTHING, Seen, Sight, seen_of


class Clock:
    now = 0.0

    def __call__(self):
        return self.now


def test_everything_is_seen_where_nobody_says_what():
    sight = Sight(Clock())
    assert sight.seen() is None
    sight.enter("a", "reader")
    assert sight.seen() == NOTHING
    sight.enter("b", "")
    assert sight.seen() is None
    sight.leave("b")
    assert sight.seen() == NOTHING
    sight.leave("a")
    assert sight.seen() is None


def test_what_several_see_is_joined():
    sight = Sight(Clock())
    sight.enter("a", "one")
    sight.enter("b", "other")
    assert sight.tell("one", Seen(frozenset("xy"), picture=True))
    assert sight.tell("other", Seen(frozenset("yz"), frozenset([(1, 2)]), frozenset(["node:/a"])))
    assert sight.seen() == Seen(frozenset("xyz"), frozenset([(1, 2)]), frozenset(["node:/a"]), picture=True)
    sight.leave("a")
    assert sight.seen() == Seen(frozenset("yz"), frozenset([(1, 2)]), frozenset(["node:/a"]))


def test_a_stream_that_lingers_does_not_take_a_reader_away():
    sight = Sight(Clock())
    sight.enter("old", "one")
    sight.enter("new", "one")
    sight.tell("one", Seen(frozenset("x")))
    sight.leave("old")
    assert sight.seen() == Seen(frozenset("x"))


def test_who_is_not_there_is_not_heard():
    sight = Sight(Clock())
    assert not sight.tell("one", NOTHING)
    sight.enter("a", "")
    assert not sight.tell("", NOTHING)


def test_who_asks_for_all_sees_all_for_a_while():
    clock = Clock()
    sight = Sight(clock)
    sight.enter("a", "one")
    sight.take_all()
    assert sight.seen() is None
    clock.now += LASTING_S + 1
    assert sight.seen() == NOTHING


def test_what_is_asked_about_is_seen_for_a_while():
    clock = Clock()
    sight = Sight(clock)
    assert not sight.ask("topic:/a"), "everything is of the present"
    sight.enter("a", "one")
    assert sight.ask("topic:/b")
    assert not sight.ask("topic:/b"), "it was asked for already"
    assert sight.seen().entities == {"topic:/a", "topic:/b"}
    clock.now += LASTING_S + 1
    assert sight.seen() == NOTHING
    assert not sight.ask("x" * 5000) or sight.seen() == NOTHING


def test_what_a_page_says_is_read():
    assert seen_of("a.b", "3:4.5", "topic:/x", "1") == Seen(
        frozenset("ab"), frozenset([(3, 4), (3, 5)]), frozenset(["topic:/x"]), picture=True
    )
    assert seen_of("", "", "", "") == NOTHING


@pytest.mark.parametrize(
    "told",
    [
        (".".join("a" * (MOST_ROWS + 1)), "", "", ""),
        ("", "3:x", "", ""),
        ("", ":1", "", ""),
        ("", "1:-1", "", ""),
        ("", "1:٣", "", ""),
        ("", "1:" + "9" * 400, "", ""),
        ("", "", "x" * 2000, ""),
    ],
)
def test_what_cannot_be_read_is_nothing(told):
    assert seen_of(*told) is None
