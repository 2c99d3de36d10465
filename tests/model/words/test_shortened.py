"""Source in messages is cut between words, and blanks at the ends of names are named."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from roslens.model.words.shortened import shortened, visible


@pytest.mark.parametrize(
    ("text", "most", "expected"),
    [
        ("short", 5, "short"),
        ("move(distance_threshold)", 12, "move(…"),
        ("one two three", 9, "one two…"),
        ("distance_threshold", 8, "distanc…"),
    ],
)
def test_a_word_is_whole_or_left_out(text, most, expected):
    assert shortened(text, most) == expected


@given(st.text(), st.integers(2, 80))
def test_it_is_never_longer_than_asked_for(text, most):
    found = shortened(text, most)
    assert len(found) <= most
    assert found == text or text.startswith(found[:-1])


@pytest.mark.parametrize(
    ("name", "expected"),
    [
        ("rate", "`rate`"),
        ("rate ", "`rate ` (ends with a blank)"),
        (" rate", "` rate` (begins with a blank)"),
        (" rate ", "` rate ` (begins and ends with a blank)"),
    ],
)
def test_a_blank_at_an_end_is_visible(name, expected):
    assert visible(name) == expected
