from roslens.source.extract.domain.abstract_value import Unknown
from roslens.source.extract.domain.unknown_lists import Each, each_of, item_of
from roslens.source.extract.symbolic.reason import EachOf, ItemOf, OfParameter
from roslens.source.extract.symbolic.text import Choice, Hole, Text, Written
from roslens.source.extract.symbolic.text_lists import is_list


def listed(default=None):
    return Text((Hole(OfParameter("names"), "names", default),))


def test_what_decides_a_list_decides_each_item():
    assert each_of(listed("[a, b]")) == Text((Hole(EachOf(OfParameter("names")), "names", among="[a, b]"),))
    assert each_of(listed("a")).holes[0].among == ""
    assert each_of(Each(3)) == 3
    assert each_of(Unknown("what is read")) == Unknown(EachOf("what is read"))


def test_of_one_of_two_lists_each_item_is_one_of_either():
    choice = Choice(Written("private"), listed(), Text.of("[c]"))
    (hole,) = each_of(Text((Hole("names if private, else c", choice=(choice,)),))).holes
    (one,) = hole.choice
    assert (one.condition, one.then) == (Written("private"), each_of(listed()))
    assert str(one.otherwise) == "{each of [c]}"


def test_an_item_at_a_place():
    assert item_of(listed("[a, b]"), 1) == Text((Hole(ItemOf(1, OfParameter("names")), "names", "b"),))
    assert item_of(listed("[a, b]"), Unknown("i")) == each_of(listed("[a, b]"))
    assert item_of(Each(Text.of("x")), 4) == Text.of("x")


def test_what_may_be_a_text_has_signs_and_no_items():
    for one in (listed(), listed("abc"), Text.of("abc"), Unknown("a")):
        assert item_of(one, 0) is None
    assert item_of(listed("[a]"), True) is None


def test_lists_by_their_default():
    assert [is_list(Hole("", "", one)) for one in (None, "", "a", "[]", "[a]")] == [False, False, False, True, True]
