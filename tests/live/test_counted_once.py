from roslens.live.join.counted_once import GIVEN_UP_S, CountedOnce


def test_the_first_who_tells_of_a_place_is_believed():
    once = CountedOnce()
    assert once.accepts("x", "a/agent", 0.0)
    assert not once.accepts("x", "b/agent", 1.0)
    assert once.accepts("y", "b/agent", 1.0)
    assert once.accepts("x", "a/agent", 2.0)


def test_a_place_of_which_nobody_tells_is_free():
    once = CountedOnce()
    once.accepts("x", "a/agent", 0.0)
    assert once.accepts("x", "b/agent", GIVEN_UP_S)
    assert not once.accepts("x", "a/agent", GIVEN_UP_S)


def test_places_beside_the_monitor_are_its_own():
    once = CountedOnce()
    assert once.accepts("x", "base/agent", 0.0)
    assert once.accepts("x", "base/monitor", 1.0)
    assert not once.accepts("x", "base/agent", 1.0)


def test_what_was_counted_nowhere_is_told_by_all():
    once = CountedOnce()
    assert all(once.accepts("", sender, 0.0) for sender in ("a", "b"))
