"""Branches and loops of a Python launch file of which it is open how they are left."""

import ast

from roslens.source.extract.launch_python.python_control import Ways
from roslens.source.extract.launch_python.python_interpreter import Interpreter
from roslens.source.extract.launch_python.python_value import Either


def returned(body):
    lines = "".join(f"    {line}\n" for line in body)
    run = Interpreter("a.launch.py", ast.parse(f"from outside import ask\ndef made():\n{lines}"))
    found = run.call(run.function("made"), [], {})
    assert run.notes == []
    return found


def test_a_function_returns_what_its_ways_return():
    ways = Ways()
    ways.returned.append(("a", 1))
    found = ways.result(2)
    assert (found.note, found.one, found.other) == ("a", 1, 2)


def test_what_follows_a_return_that_is_open_is_followed():
    found = returned(["if True:", "    if ask():", "        return 1", "return 2"])
    assert isinstance(found, Either)
    assert (found.note, found.one, found.other) == ("ask()", 1, 2)


def test_a_name_that_a_branch_sets_is_one_or_the_other():
    found = returned(["name = 'a'", "if ask():", "    name = 'b'", "return name"])
    assert (found.one, found.other) == ("b", "a")


def test_a_loop_ends_at_break_and_goes_on_at_continue():
    assert returned(["n = 0", "for i in [1, 2, 3]:", "    n = i", "    break", "return n"]) == 1
    assert (
        returned(["n = 0", "for i in [1, 2, 3]:", "    if i == 2:", "        continue", "    n += i", "return n"]) == 4
    )
    assert returned(["n = 0", "while n < 3:", "    n += 1", "    if n == 1:", "        continue", "return n"]) == 3


def test_what_stands_behind_else_is_followed_where_no_break_was_met():
    assert returned(["for i in [1]:", "    pass", "else:", "    return 'a'", "return 'b'"]) == "a"
    assert returned(["for i in [1]:", "    break", "else:", "    return 'a'", "return 'b'"]) == "b"
