from roslens.source.extract.domain.abstract_value import Callable, Obj
from roslens.source.extract.domain.table_key import hashable
from roslens.source.extract.ir.program import Function
from roslens.source.extract.symbolic.text import Text


def test_texts_and_numbers_are_keys_by_what_they_are():
    assert hashable(Text.of("a")) == Text.of("a")
    assert hashable([1, Text.of("a")]) == hashable([1, Text.of("a")])
    assert hashable([1]) != hashable([2])


def test_objects_are_keys_by_which_they_are_whatever_becomes_of_them():
    one, other = Obj("A", fields={"x": 1}), Obj("A", fields={"x": 1})
    table = {hashable(one): 1, hashable(other): 2}
    one.fields["x"] = 3
    assert (table[hashable(one)], table[hashable(other)]) == (1, 2)
    assert str(hashable(one)) == "a A"


def test_a_method_is_another_one_of_another_object():
    function, one = Function("f", "A.f", 1), Obj("A")
    assert hashable(Callable(function, "a.py", one)) == hashable(Callable(function, "a.py", one))
    assert hashable(Callable(function, "a.py", one)) != hashable(Callable(function, "a.py", Obj("A")))


def test_a_key_takes_no_longer_the_more_objects_know_of_each_other():
    last = Obj("A")
    for _ in range(60):
        last = Obj("A", fields={"left": last, "right": last})
    assert hashable(last) == hashable(last)
    assert hashable([last]) != hashable([Obj("A")])
    assert hashable({"a": last}) is not None
