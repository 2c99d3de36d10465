"""What is one thing or another is taken for neither: by conditions, functions that end, loops and tables."""

import pytest

from roslens.source.extract.symbolic.condition import as_written

HEAD = """
from rclpy.node import Node
from std_msgs.msg import String
from outside import ask, text, number
"""


def made(units, body, before=""):
    """Return names and conditions of what a node makes."""
    inner = "\n".join(f"        {line}" for line in body.strip("\n").split("\n"))
    program = f"{HEAD}{before}\nclass Main(Node):\n    def __init__(self):\n        super().__init__('main')\n{inner}\n"
    (found,) = units(main_py=program)
    return [(one.name, as_written(one.conditions)) for one in found.endpoints]


def names(units, body, before=""):
    return [name.known for name, _ in made(units, body, before)]


MAKE = "self.create_publisher(String, {}, 10)"


def test_what_may_be_none_is_not_there_for_sure(units):
    for body in ("n = None\nif ask():\n    n = 'a'", "n = 'a'\nif ask():\n    n = None", "n = 'a' if ask() else None"):
        ((name, conditions),) = made(units, f"{body}\nif n:\n    {MAKE.format('n')}")
        assert (name.known, conditions) == (None, ("n",))
    ((name, conditions),) = made(units, f"n = None\nif ask():\n    n = 3\nif n:\n    {MAKE.format(repr('a'))}")
    assert (name.known, conditions) == ("a", ("n",))


def test_a_function_whose_end_is_reached_returns_none(units):
    before = "def found(a):\n    if ask():\n        return a\n"
    ((name, _),) = made(units, f"n = found('a')\nif n:\n    {MAKE.format('n')}", before)
    assert name.known is None
    assert name.holes[0].choice


@pytest.mark.parametrize("value", ["3 if ask() else 2", "3 if ask() else number()", "(3 if ask() else 2) or 1"])
def test_one_of_two_numbers_is_no_depth(units, value):
    inner = f"        self.create_publisher(String, 'a', {value})"
    (found,) = units(
        main_py=f"{HEAD}class Main(Node):\n    def __init__(self):\n        super().__init__('m')\n{inner}\n"
    )
    assert found.endpoints[0].qos_unknown


def test_a_loop_that_may_have_no_turn_is_a_condition(units):
    assert made(units, f"while ask():\n    {MAKE.format(repr('a'))}")[0][1] == ("ask()",)
    assert made(units, f"while rclpy.ok():\n    {MAKE.format(repr('a'))}")[0][1] == ()


def test_what_follows_a_loop_that_was_not_left_depends_on_that(units):
    loop = "for i in ['a', 'b']:\n    if ask():\n        {}\nelse:\n    " + MAKE.format(repr("c"))
    assert made(units, loop.format("break"))[0][1] == ("no break",)
    assert made(units, loop.format("continue"))[0][1] == ()


def test_items_that_a_list_may_have_keep_their_condition(units):
    told = made(units, f"for i in [i for i in ['a', 'b'] if ask()]:\n    {MAKE.format('i')}")
    assert [(name.known, conditions) for name, conditions in told] == [("a", ("ask()",)), ("b", ("ask()",))]
    told = made(units, f"x = ['a']\nif ask():\n    x = x + ['b']\nfor i in x:\n    {MAKE.format('i')}")
    assert [(name.known, conditions) for name, conditions in told] == [("a", ()), ("b", ("ask()",))]
    assert names(units, f"x = [i for i in ['a'] if ask()] + ['b']\n{MAKE.format('x[0]')}") == [None]
    assert made(units, f"if [i for i in ['a'] if ask()]:\n    {MAKE.format(repr('b'))}")[0][1] != ()


def test_items_that_a_table_may_have_keep_their_condition(units):
    table = "d = {'x': 'a'}\nif ask():\n    d['y'] = 'b'\n"
    told = made(units, f"{table}for key, value in d.items():\n    {MAKE.format('value')}")
    assert [(name.known, conditions) for name, conditions in told] == [("a", ()), ("b", ("ask()",))]
    assert names(units, f"{table}{MAKE.format('d.get(' + repr('y') + ', ' + repr('q') + ')')}") == [None]


def test_an_unknown_key_gives_no_default(units):
    assert names(
        units, f"{MAKE.format('{1: 2}.get(text(), 3)')}".replace("1: 2", "'x': 'a'").replace("3)", "'q')")
    ) == [None]
    assert names(units, f"d = {{text(): 'a'}}\n{MAKE.format('d.get(' + repr('x') + ', ' + repr('q') + ')')}") == [None]
    assert names(units, f"d = {{'x': 'a'}}\ne = {{**d, 'y': 'b'}}\n{MAKE.format('e[' + repr('x') + ']')}") == ["a"]


def test_lists_are_given_to_functions_as_they_are(units):
    before = "def f(items):\n    return '_'.join(items)\n"
    assert names(units, MAKE.format("f(['a', 'b'])"), before) == ["a_b"]
    assert names(units, f"x: list[str] = ['a', 'b']\nn: float = 1\n{MAKE.format('x[1] + str(n)')}") == ["b1"]


def test_a_default_is_one_list(units):
    before = "def f(x, kept=[]):\n    kept.append(x)\n    return kept\n"
    assert names(units, f"f('a')\nfor i in f('b'):\n    {MAKE.format('i')}", before) == ["a", "b"]


def test_what_a_function_of_the_module_sets_is_unknown_to_others(units):
    before = "name = 'a'\ndef set_it():\n    global name\n    name = 'b'\n"
    assert names(units, f"{MAKE.format('name')}\nif ask():\n    set_it()\n{MAKE.format('name')}", before) == ["a", None]


def test_formats_that_are_not_followed_are_unknown(units):
    for template, rest in (("{0}{1}{0}", ".format('x', 'y')"), ("{a}", ".format(a='x')"), ("%d%%%s", " % (1, 's')")):
        assert names(units, f"t = '{template}'\n{MAKE.format('t' + rest)}") == [None]
    assert names(units, f"flag = True\n{MAKE.format('f' + repr('{flag}'))}") == ["True"]


def test_a_set_has_an_item_once(units):
    assert names(units, MAKE.format("'_'.join(set(['a', 'a']))")) == ["a"]
