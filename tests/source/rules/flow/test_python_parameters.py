"""How many arguments functions of Python take."""

import pytest

from roslens.model.source import Language
from roslens.source.parsed_file import parse_file
from roslens.source.rules.flow.python_parameters import Takes, parameters_of, takes_of
from roslens.source.rules.flow.summary import Target
from roslens.source.settings import MacroSettings


def function_of(parameters):
    view = parse_file(f"def f({parameters}):\n    pass\n".encode(), Language.PYTHON, MacroSettings()).view()
    return next(one for one in view.root.named_children), view


@pytest.mark.parametrize(
    ("parameters", "bound", "keywords", "expected"),
    [
        ("", 0, (), Takes(0, 0)),
        ("self", 1, (), Takes(0, 0)),
        ("self, a", 1, (), Takes(1, 1)),
        ("a, b=1", 0, (), Takes(1, 2)),
        ("a: int, b: int = 1", 0, (), Takes(1, 2)),
        ("*a", 1, (), Takes(0, None)),
        ("a, *rest: int", 0, (), Takes(1, None)),
        ("a, **rest", 0, (), Takes(1, 1)),
        ("a, *, b", 0, (), Takes(1, 1, ("b",))),
        ("a, *, b=1", 0, (), Takes(1, 1)),
        ("a, /, b", 0, (), Takes(2, 2)),
        ("a, b", 0, ("b",), Takes(1, 1)),
        ("a, b, c", 0, ("b",), Takes(1, 1, ("c",))),
        ("", 2, (), Takes(0, 0)),
    ],
)
def test_what_is_bound_is_no_longer_given(parameters, bound, keywords, expected):
    function, view = function_of(parameters)
    assert takes_of(Target(function, bound, frozenset(keywords)), view) == expected


def test_parameters_have_their_names():
    function, view = function_of("self, a: int, b=2, *rest, c: str = '', **more")
    assert [one.name for one in parameters_of(function, view)] == ["self", "a", "b", "*", "c", "**"]
