"""How long a message waits for the first subscriber."""

import pytest

from roslens.live.adapters.ros2.meeting import patience_s


@pytest.mark.parametrize("known", [True, False])
def test_the_first_message_waits_longest(known):
    assert patience_s(known=known, first=True) > patience_s(known=known, first=False)


@pytest.mark.parametrize("first", [True, False])
def test_it_waits_longer_for_a_subscription_that_there_is(first):
    assert patience_s(known=True, first=first) > patience_s(known=False, first=first)


def test_what_is_repeated_waits_for_nobody_where_nobody_is():
    assert patience_s(known=False, first=False) == 0
