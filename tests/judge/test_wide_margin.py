import pytest

from roslens.judge.reading.read_reference import GivenText, load_reference
from roslens.judge.reference.merge_references import constraints_of
from roslens.judge.reference.wide_margin import COUNTED, wide_margins
from roslens.live.window.signals import BY_KEY, ENDS

HEAD = "kind: reference\nname: r\ndefaults: {margin: 5 %}\nconstraints:\n  - "


@pytest.mark.parametrize(
    ("constraint", "warned"),
    [
        ("{topic: /a, rate: 9.8..10.2 Hz}", True),
        ("{topic: /a, rate: 8..12 Hz}", False),
        ("{topic: /a, rate: 9.8..10.2 Hz, margin: 0 %}", False),
        ("{topic: /a, rate: '>= 10 Hz'}", False),
        ("{topic: /a, publishers: 1}", False),
        ("{topic: /a, subscribers: 30..31}", False),
        ("{parameter: /a/b, value: 99..100}", False),
    ],
)
def test_a_margin_that_is_wider_than_its_range_is_warned_of(constraint, warned):
    loaded = load_reference([GivenText("r.yaml", (HEAD + constraint).encode())], BY_KEY)
    found = list(wide_margins(constraints_of(loaded)))
    assert bool(found) is warned
    if found:
        assert found[0].startswith("r.yaml:5: the margin of 5 % is wider than the range of topic /a")


def test_counts_are_the_same_where_they_are_judged():
    assert COUNTED == ENDS
