"""``cmake_parse_arguments()``."""

from pathlib import Path

from roslens.source.extract.builds.cmake_blocks import BLOCKS
from roslens.source.extract.builds.cmake_commands import COMMANDS, IGNORED
from roslens.source.extract.builds.cmake_evaluation import Evaluation
from roslens.source.extract.builds.cmake_syntax import parse_cmake
from roslens.source.extract.facts.files import FolderFiles

WORDS = '"QUIET;LOUD" "ONE;OTHER" "MANY;MORE"'


def after(text):
    run = Evaluation("", FolderFiles(Path(), {}), [], COMMANDS, IGNORED, BLOCKS)
    run.run_file("CMakeLists.txt", parse_cmake(text.encode()))
    return {name: run.variables.get(f"A_{name}") for name in (
        "QUIET", "LOUD", "ONE", "OTHER", "MANY", "MORE", "UNPARSED_ARGUMENTS", "KEYWORDS_MISSING_VALUES"
    )}  # fmt: skip


def test_keywords():
    found = after(f"cmake_parse_arguments(A {WORDS} x QUIET ONE 1 y MANY a b OTHER MANY c)")
    assert found == {
        "QUIET": "TRUE", "LOUD": "FALSE", "ONE": "1", "OTHER": None, "MANY": "a;b;c", "MORE": None,
        "UNPARSED_ARGUMENTS": "x;y", "KEYWORDS_MISSING_VALUES": "OTHER",
    }  # fmt: skip


def test_a_keyword_is_without_values_wherever_it_is_so_and_they_are_sorted():
    found = after(f"cmake_parse_arguments(A {WORDS} OTHER MANY a MORE MANY)")
    assert found["MANY"] == "a"
    assert found["KEYWORDS_MISSING_VALUES"] == "MANY;MORE;OTHER"


def test_lists_in_the_arguments_of_a_function_stay_together():
    given = (
        f"function(f p)\ncmake_parse_arguments(PARSE_ARGV 1 A {WORDS})\nforeach(n ONE MANY)\n"
        'set(A_${n} "${A_${n}}" PARENT_SCOPE)\nendforeach()\nendfunction()\nf(x ONE "a;b" MANY "c;d" e)'
    )
    found = after(given)
    assert (found["ONE"], found["MANY"]) == ("a;b", "c\\;d;e")
