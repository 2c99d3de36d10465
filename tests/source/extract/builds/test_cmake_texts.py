"""``list()`` and ``string()`` of what is unknown, wrong or too long; test_cmake_blocks holds the rest against cmake."""

from pathlib import Path

import pytest

from roslens.source.extract.builds.cmake_blocks import BLOCKS
from roslens.source.extract.builds.cmake_evaluation import Evaluation, ExhaustedError
from roslens.source.extract.builds.cmake_lists import LIST
from roslens.source.extract.builds.cmake_syntax import parse_cmake
from roslens.source.extract.builds.cmake_texts import STRING
from roslens.source.extract.builds.cmake_value import hole, is_unknown
from roslens.source.extract.facts.files import FolderFiles


def after(text, **first):
    run = Evaluation("", FolderFiles(Path(), {}), [], {**LIST, **STRING}, frozenset(), BLOCKS)
    for name, value in first.items():
        run.variables.set(name, value)
    run.run_file("CMakeLists.txt", parse_cmake(text.encode()))
    return run


def test_lists_of_what_is_unknown():
    run = after("list(APPEND L b)\nlist(LENGTH L N)\nlist(GET L 0 G)\nlist(SORT L)", L=f"a;{hole('x')}")
    assert is_unknown(run.variables.get("N"))
    assert is_unknown(run.variables.get("G"))
    assert is_unknown(run.variables.get("L"))


@pytest.mark.parametrize(
    "text",
    ["list(GET L 9 R)", "list(GET L x R)", "list(SUBLIST L a b R)",
     "string(SUBSTRING abc x 1 R)", "string(REPEAT ab 99999999 R)",
     'string(REGEX REPLACE "(a*)*" x R aaa)', "string(UNHEARD a R)", "string(REPLACE)", "list(NOTHING L R)"],
)  # fmt: skip
def test_what_is_wrong_is_unknown(text):
    run = after(text, L="a;b")
    value = run.variables.get("R")
    assert value is None or is_unknown(value)


def test_strings_of_what_is_unknown():
    run = after('string(TOUPPER "${X}" A)\nstring(REPLACE a b B "${X}")\nstring(FIND "${X}" a C)', X=f"a{hole('x')}")
    assert all(is_unknown(run.variables.get(name)) for name in "ABC")


def test_text_is_bounded():
    with pytest.raises(ExhaustedError):
        after("string(APPEND A ${B})\n" * 1000, B="x" * 90_000)
