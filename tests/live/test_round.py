"""A tick ends a round for all who share it."""

from roslens.live.window.round import Round


def test_a_round_goes_on_until_a_tick_ends_it():
    one = Round()
    assert one.time is None
    one.time = 3.0
    assert one.time == 3.0
