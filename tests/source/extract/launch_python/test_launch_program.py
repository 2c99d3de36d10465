"""What the interpreter does otherwise in launch files in Python: choices, arguments, operators."""

import pytest

from roslens.source.extract.domain.abstract_value import Unknown
from roslens.source.extract.launch_python.deferred import Deferred
from roslens.source.extract.launch_python.launch_program import LaunchProgram
from roslens.source.extract.launch_python.launch_values import Either, Made, plain
from roslens.source.extract.transfer.budget import BudgetExceededError

HEAD = """
from outside import ask
from launch.substitutions import LaunchConfiguration
NAME = LaunchConfiguration('name')
ITEMS, TABLE = ['x', 'y'], {'k': 1}
"""
NAME = Deferred("configuration", ("name",))


def returned(body, before=""):
    lines = "".join(f"    {line}\n" for line in body)
    run = LaunchProgram("a.launch.py", f"{HEAD}{before}\ndef made():\n{lines}".encode())
    found = run.run(run.entry("made"), [], {})
    assert run.state.conditions == []
    return plain(found)


def value(expression):
    return returned([f"return {expression}"])


def choice(found):
    assert isinstance(found, Either)
    return str(found.condition), *map(plain, (found.one, found.other))


def test_what_follows_a_return_that_is_open_is_followed():
    assert choice(returned(["if True:", "    if ask():", "        return 1", "return 2"])) == ("ask()", 1, 2)


def test_a_name_that_a_branch_sets_is_one_or_the_other():
    assert choice(returned(["name = 'a'", "if ask():", "    name = 'b'", "return name"])) == ("ask()", "b", "a")
    assert choice(value("'a' if ask() else NAME")) == ("ask()", "a", NAME)


def test_a_list_of_which_a_branch_makes_another_one_is_one_or_the_other():
    found = returned(["names = ['a']", "if ask():", "    names = ['b', 'c']", "return names"])
    assert choice(found) == ("ask()", ["b", "c"], ["a"])


def test_what_a_function_does_after_it_may_have_returned_is_no_part_of_what_it_returned():
    before = "from launch import LaunchDescription\nfrom launch_ros.actions import Node\n"
    body = ["found = LaunchDescription()", "if ask():", "    return found", "found.add_action(Node())", "return found"]
    condition, one, other = choice(returned(body, before))
    assert condition == "ask()"
    assert isinstance(one, Made)
    assert (len(one.positional), len(other.positional)) == (0, 1)


def test_a_loop_ends_at_break_and_goes_on_at_continue():
    assert returned(["n = 0", "for i in [1, 2, 3]:", "    n = i", "    break", "return n"]) == 1
    body = ["n = 0", "for i in [1, 2, 3]:", "    if i == 2:", "        continue", "    n += i", "return n"]
    assert returned(body) == 4
    assert returned(["n = 0", "while n < 3:", "    n += 1", "    if n == 1:", "        continue", "return n"]) == 3


def test_a_loop_without_end_spends_what_there_is():
    with pytest.raises(BudgetExceededError):
        returned(["while True:", "    pass", "return 1"])


def test_what_stands_behind_else_is_followed_where_no_break_was_met():
    assert returned(["for i in [1]:", "    pass", "else:", "    return 'a'", "return 'b'"]) == "a"
    assert returned(["for i in [1]:", "    break", "else:", "    return 'a'", "return 'b'"]) == "b"
    found = returned(["for i in [1]:", "    if ask():", "        break", "else:", "    return 'a'", "return 'b'"])
    assert choice(found) == ("no break", "a", "b")


@pytest.mark.parametrize(("met", "found"), [("a", "a"), ("b", "b"), ("c", "other")])
def test_a_break_that_is_certain_leaves_out_what_stands_behind_else(met, found):
    body = ["for one in ['a', 'b']:", f"    if one == {met!r}:", "        found = one", "        break"]
    assert returned([*body, "else:", "    found = 'other'", "return found"]) == found


@pytest.mark.parametrize(
    ("call", "expected"),
    [
        ("f(1, 'a', z=2)", [1, ["a"], 3, {"z": 2}]),
        ("f(*ITEMS, 3)", ["x", ["y", 3], 3, {}]),
        ("f(1, c=4, **TABLE)", [1, [], 4, {"k": 1}]),
    ],
)
def test_arguments(call, expected):
    function = "def f(a, *rest, c=3, **more):\n    return [a, rest, c, more]\n"
    assert returned([f"return {call}"], function) == expected


def test_an_argument_that_is_not_given_is_unknown():
    assert isinstance(returned(["return f()"], "def f(a):\n    return a\n"), Unknown)


@pytest.mark.parametrize(
    ("expression", "result"),
    [
        ("1 + 2", 3),
        ("'a' + 'b'", "ab"),
        ("['a'] + ['b']", ["a", "b"]),
        ("[*ITEMS, 'z']", ["x", "y", "z"]),
        ("'a' + NAME", Deferred("text", ("a", NAME))),
        ("'a' / 'b'", Deferred("path", ("a", "b"))),
        ("NAME / 'b'", Deferred("path", (NAME, "b"))),
        ("'%s_%d' % ('a', 5)", "a_5"),
        ("7 % 4", 3),
        ("1 < 2 <= 2", True),
        ("'x' in ITEMS", True),
        ("'k' not in TABLE", False),
        ("None is None", True),
        ("ITEMS[-1]", "y"),
        ("{**TABLE, 'l': 2}", {"k": 1, "l": 2}),
        ("TABLE.get('missing')", None),
        ("[one + '_' for one in ITEMS if one != 'x']", ["y_"]),
        ("{one: len(one) for one in ITEMS}", {"x": 1, "y": 1}),
        ("list(range(20))[-1]", 19),
        ("str(5) + 'x'", "5x"),
        ("(lambda one: one + 'y')('x')", "xy"),
    ],
)
def test_values_are_put_together(expression, result):
    assert value(expression) == result


@pytest.mark.parametrize(
    "expression",
    ["'%100000d' % 1", "'a' * 100000", "1 / 0", "2 ** 100000", "NAME - 1", "[1] * 3000", "missing", "'a' < 1"],
)
def test_what_is_not_followed_is_unknown(expression):
    found = value(f"[{expression}]")[0]
    assert not isinstance(found, str | int | float | list | dict)
