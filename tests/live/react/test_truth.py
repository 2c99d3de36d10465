"""Three-valued logic: what is true with unknowns stays true whatever they turn out to be."""

from itertools import product

import pytest
from hypothesis import given
from hypothesis import strategies as st

from roslens.live.react.truth import all_of, any_of, at_least, negated

TRUTHS = st.lists(st.sampled_from([True, False, None]), max_size=6)


def completions(parts):
    return product(*[(True, False) if part is None else (part,) for part in parts])


@given(TRUTHS, st.integers(0, 6))
def test_what_is_known_in_spite_of_unknowns_holds_for_each_way_they_can_turn_out(parts, count):
    for joined, plain in (
        (all_of, all),
        (any_of, any),
        (lambda ps: at_least(count, ps), lambda ps: sum(ps) >= count),
        (lambda ps: negated(all_of(ps)), lambda ps: not all(ps)),
    ):
        outcomes = {plain(one) for one in completions(parts)}
        # These connectives are monotone, so that unknown is said only where both can come out.
        assert joined(parts) == (outcomes.pop() if len(outcomes) == 1 else None)


@pytest.mark.parametrize(("part", "opposite"), [(True, False), (False, True), (None, None)])
def test_the_opposite(part, opposite):
    assert negated(part) is opposite
