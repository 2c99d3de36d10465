"""One text for each item of a list that a parameter is."""

import pytest

from roslens.source.extract.parameters.assemble_lists import each_of, items_among, parameter_of
from roslens.source.extract.symbolic.reason import MAKER, EachOf, ItemOf, NumberBelow, OfParameter, PartOf
from roslens.source.extract.symbolic.text import Hole, Text, unknown

EACH = Hole(EachOf(OfParameter("names")), "names")
OTHER = Hole(EachOf(OfParameter("others")), "others")
SET = {"names": ["a", "b"], "others": ["x", "y"], "a.parts": ["p", "q"], "b.parts": []}


def items(hole):
    return items_among(hole, Text.of(f"[{', '.join(SET[hole.parameter])}]")) if hole.parameter in SET else None


def patterns(*texts):
    return [tuple(str(one) for one in found) for found in each_of(texts, items)]


def named(hole, last, *default, each=False):
    name = Text.of(hole, last)
    reason = OfParameter(str(name))
    return Hole(EachOf(reason) if each else reason, name.pattern, named=(name, *default))


def test_an_item_is_the_same_in_all_its_places():
    assert patterns(Text.of(EACH, "/", EACH), Text.of("t/", EACH)) == [("a/a", "t/a"), ("b/b", "t/b")]


def test_lists_that_have_nothing_to_do_with_each_other_are_not_crossed():
    assert patterns(Text.of(EACH, "/", OTHER)) == [
        ("a/{each of parameter others}",), ("b/{each of parameter others}",),
    ]  # fmt: skip


def test_a_parameter_that_an_item_names():
    (one,), (other,) = each_of((Text.of(named(EACH, ".topic")),), items)
    assert one == Text((Hole(OfParameter("a.topic"), "a.topic"),))
    assert other == Text((Hole(OfParameter("b.topic"), "b.topic"),))


def test_its_default_may_have_the_item_in_it():
    hole = named(EACH, ".topic", Text.of(EACH, "/scan"))
    (one,), _ = each_of((Text.of(hole),), items)
    assert one.holes[0].default == "a/scan"


def test_a_list_that_an_item_names():
    parts = named(EACH, ".parts", each=True)
    assert patterns(Text.of(EACH, "/", parts)) == [
        ("a/p",), ("a/q",), ("b/{each of parameter b.parts, which is empty}",),
    ]  # fmt: skip


def test_what_nobody_knows_stays():
    assert patterns(Text.of("t/", unknown("a file"))) == [("t/{a file}",)]
    hole = named(Hole(EachOf(OfParameter("more")), "more"), ".topic")
    assert patterns(Text.of(hole)) == [("{parameter {each of parameter more}.topic}",)]


@pytest.mark.parametrize(
    ("hole", "value", "found"),
    [
        (EACH, "[a, 'b']", ["a", "b"]),
        (EACH, "[]", []),
        (EACH, "a", None),
        (EACH, None, None),
        (Hole(EachOf(OfParameter("names")), "names", among="[c]"), None, ["c"]),
        (Hole(ItemOf(1, OfParameter("names")), "names"), "[a, b]", ["b"]),
        (Hole(ItemOf(-1, OfParameter("names")), "names"), "[a, b]", ["b"]),
        (Hole(ItemOf(2, OfParameter("names")), "names"), "[a, b]", []),
        (Hole(EachOf("a part of {parameter names}"), "names"), "[a, b]", None),
        (Hole(EachOf(EachOf(OfParameter("names"))), "names"), "[a, b]", None),
        (Hole(EachOf(OfParameter("names", 2)), "names"), "[a, b]", None),
        (Hole(PartOf("type", EachOf(OfParameter("names"))), "names"), "[{type: a}]", None),
        (Hole(EachOf(OfParameter("names", MAKER)), "names"), "[a, b]", None),
    ],
)
def test_the_items_of_a_list(hole, value, found):
    assert items_among(hole, None if value is None else Text.of(value)) == found


@pytest.mark.parametrize(
    ("default", "value", "expected"),
    [
        ("2", None, ["0", "1"]),
        ("2", "3", ["0", "1", "2"]),
        ("", "1", ["0"]),
        ("", None, None),
        ("2", "0", []),
        ("2", "many", None),
        ("2", "1000", None),
        ("2", unknown("argument n"), None),
    ],
)
def test_numbers_below_a_parameter_are_as_many_as_it_says(default, value, expected):
    given = Text.of(value) if isinstance(value, str) else value
    assert items_among(Hole(NumberBelow(OfParameter("n"), default)), given) == expected


def test_the_parameter_that_ends_a_loop_decides_its_numbers():
    assert parameter_of(Hole(NumberBelow(OfParameter("n")))) == "n"
    assert parameter_of(Hole(NumberBelow(OfParameter("n", MAKER)))) == ""
    assert parameter_of(EACH) == "names"
