import ast

import pytest

from roslens.source.extract.launch_python.python_arguments import bound, given, items_of
from roslens.source.extract.launch_python.python_value import Unknown

NAMES = {"items": ["x", "y"], "table": {"k": 1}, "open": Unknown("open")}


def value(node):
    return NAMES[node.id] if isinstance(node, ast.Name) else node.value


@pytest.mark.parametrize(
    ("call", "positional", "named"),
    [
        ("f(1, 'a', z=2)", [1, "a"], {"z": 2}),
        ("f(*items, 3)", ["x", "y", 3], {}),
        ("f(*open, **table)", [], {"k": 1}),
        ("f(**open)", [], {}),
    ],
)
def test_what_is_given(call, positional, named):
    assert given(ast.parse(call, mode="eval").body, value) == (positional, named)


def test_parameters_are_bound():
    function = ast.parse("def f(a, b, c=3, *rest, d, e=5, **more): pass").body[0]
    assert bound(function.args, [1], {"c": 4, "d": 6, "q": 7}, value) == {
        "a": 1, "b": Unknown("parameter b"), "c": 4, "d": 6, "e": 5, "rest": [], "more": {"q": 7},
    }  # fmt: skip
    assert bound(function.args, [1, 2, 3, 4, 5], {}, value)["rest"] == [4, 5]


def test_items():
    assert items_of({"a": 1}) == ["a"]
    assert items_of(5) is None
