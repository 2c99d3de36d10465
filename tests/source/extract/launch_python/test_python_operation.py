import ast

import pytest

from roslens.source.extract.launch_python.deferred import Deferred
from roslens.source.extract.launch_python.python_operation import combined, compared, put
from roslens.source.extract.launch_python.python_value import Unknown

NAME = Deferred("configuration", ("name",))


@pytest.mark.parametrize(
    ("one", "operator", "other", "result"),
    [
        (1, ast.Add(), 2, 3),
        ("a", ast.Add(), "b", "ab"),
        (["a"], ast.Add(), ["b"], ["a", "b"]),
        ("a", ast.Add(), NAME, Deferred("text", ("a", NAME))),
        ("a", ast.Div(), "b", Deferred("path", ("a", "b"))),
        (NAME, ast.Div(), "b", Deferred("path", (NAME, "b"))),
        ("%s_%d", ast.Mod(), ["a", 5], "a_5"),
        ("%s", ast.Mod(), NAME, Deferred("text", ("", NAME, ""))),
        (7, ast.Mod(), 4, 3),
    ],
)
def test_values_are_put_together(one, operator, other, result):
    assert combined(operator, one, other) == result


@pytest.mark.parametrize(
    ("one", "operator", "other"),
    [
        ("a", ast.Add(), 1),
        ("%100000d", ast.Mod(), 1),
        ("a", ast.Mult(), 100_000),
        (1, ast.Div(), 0),
        (2, ast.Pow(), 100_000),
        (NAME, ast.Sub(), 1),
        ([1], ast.Mult(), 3),
        (Unknown("x"), ast.Add(), 1),
    ],
)
def test_what_is_not_followed_is_unknown(one, operator, other):
    assert isinstance(combined(operator, one, other), Unknown)


def test_comparisons_and_items():
    assert compared([ast.Lt(), ast.LtE()], [1, 2, 2]) is True
    assert compared([ast.Lt()], ["a", 1]) is None
    items, table = [1, 2], {}
    put(items, 1, 5)
    put(items, 9, 5)
    put(table, "a", 1)
    put(table, [], 1)
    assert (items, table) == ([1, 5], {"a": 1})
