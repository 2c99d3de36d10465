"""Programs that say where their expressions stand."""

from roslens.source.extract.ir.program import Assign, Branch, Operation, Sequence
from roslens.source.extract.lowering.python.located_program import located_program


def test_equal_expressions_have_places_of_their_own():
    program, places = located_program(b"a = ['x',\n     'x']\n")
    value = program.body[0].value
    found = [places.of(one) for one in value.items]
    assert [(one.line, one.column, one.text) for one in found] == [(1, 6, "'x'"), (2, 6, "'x'")]


def test_what_is_spread_out_in_a_list_is_kept():
    program, _ = located_program(b"a = [*b, c]\nf(*b)\n")
    value = program.body[0].value
    assert isinstance(value, Sequence)
    assert isinstance(value.items[0], Operation)
    assert (value.items[0].operator, value.items[0].operands[0].name) == ("*", "b")


def test_what_handles_exceptions_may_be_left_out():
    text = b"try:\n    a = 1\nexcept E:\n    a = 2\nelse:\n    b = 3\nfinally:\n    c = 4\n"
    assert isinstance(located_program(text)[0].body[0], Branch)
    assert [one.target.name for one in located_program(text, handlers=False)[0].body if isinstance(one, Assign)] == [
        "a", "b", "c",
    ]  # fmt: skip
