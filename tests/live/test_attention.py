from __future__ import annotations

from roslens.live.reported.attention import PAUSE_S, SETTLE_S, Attention


def test_who_was_stopped_does_not_vouch_for_what_waited():
    attention = Attention(0.0)
    assert attention.turn(0.5)
    assert not attention.turn(0.5 + PAUSE_S + 0.1)
    assert not attention.turn(0.5 + PAUSE_S + 0.3)
    assert attention.turn(0.6 + PAUSE_S + SETTLE_S + 0.1)


def test_between_turns_it_is_there_until_the_next_is_late():
    attention = Attention(0.0, pause_s=2.0)
    assert attention.there(1.9)
    assert not attention.there(2.1)
    attention.turn(4.0)
    assert not attention.there(4.0 + SETTLE_S / 2)
    assert attention.there(4.0 + SETTLE_S)
