"""``list()``: what the scripts that are held against cmake do not hold."""

from pathlib import Path

import pytest

from roslens.source.extract.builds.cmake_blocks import BLOCKS
from roslens.source.extract.builds.cmake_commands import COMMANDS, IGNORED
from roslens.source.extract.builds.cmake_evaluation import Evaluation
from roslens.source.extract.builds.cmake_syntax import parse_cmake
from roslens.source.extract.builds.cmake_value import hole, is_unknown
from roslens.source.extract.facts.files import FolderFiles


def after(text, **first):
    run = Evaluation("", FolderFiles(Path(), {}), [], COMMANDS, IGNORED, BLOCKS)
    for name, value in first.items():
        run.variables.set(name, value)
    run.run_file("CMakeLists.txt", parse_cmake(text.encode()))
    return run


@pytest.mark.parametrize(
    ("command", "value"),
    [
        ("list(SORT L CASE INSENSITIVE)", "a;B;c"),
        ("list(SORT L ORDER DESCENDING)", "c;a;B"),
        ("list(TRANSFORM L TOUPPER AT 0 -1)", "C;a;B"),
        ("list(TRANSFORM L APPEND _x FOR 1 2)", "c;a_x;B_x"),
        ("list(TRANSFORM L PREPEND y REGEX [a-c])", "yc;ya;B"),
        ('list(TRANSFORM L REPLACE "^(.)" "<\\\\1>")', "<c>;<a>;<B>"),
        ('list(APPEND L "")', "c;a;B;"),
        ("list(PREPEND L x y)", "x;y;c;a;B"),
    ],
)
def test_lists_are_changed(command, value):
    assert after(command, L="c;a;B").variables.get("L") == value


def test_what_transform_gives_to_another_variable_leaves_the_list():
    found = after("list(TRANSFORM L APPEND .cpp OUTPUT_VARIABLE S)", L="one;two")
    assert (found.variables.get("L"), found.variables.get("S")) == ("one;two", "one.cpp;two.cpp")


def test_several_are_taken_from_an_end():
    found = after("list(POP_FRONT L A B)\nlist(POP_BACK L C D)", L="1;2;3", D="old")
    assert [found.variables.get(name) for name in "LABCD"] == ["", "1", "2", "3", None]


def test_what_is_escaped_stays_so():
    found = after('list(APPEND L "a\\;b" c)\nlist(LENGTH L N)\nlist(APPEND L d)\nlist(LENGTH L M)')
    assert (found.variables.get("N"), found.variables.get("M")) == ("2", "3")


def test_natural_order_is_not_known():
    assert is_unknown(after("list(SORT L COMPARE NATURAL)", L="a10;a9").variables.get("L"))


def test_lists_of_what_is_unknown():
    found = after("list(POP_BACK L A)\nlist(FIND M x F)", L=f"a;{hole('x')}", M=hole("y"))
    assert all(is_unknown(found.variables.get(name)) for name in "LAF")


def test_what_transform_has_matched_is_unknown():
    found = after('string(REGEX MATCH "(a)" R a)\nlist(TRANSFORM L REPLACE x y)', L="x;z")
    assert found.variables.get("L") == "y;z"
    assert is_unknown(found.variables.get("CMAKE_MATCH_0"))
