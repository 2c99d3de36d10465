"""The language of CMake, held against what cmake itself writes for the same scripts."""

import shutil
import subprocess
from pathlib import Path

import pytest

from roslens.source.extract.builds.cmake_blocks import BLOCKS
from roslens.source.extract.builds.cmake_commands import COMMANDS, IGNORED
from roslens.source.extract.builds.cmake_evaluation import Evaluation
from roslens.source.extract.builds.cmake_syntax import parse_cmake
from roslens.source.extract.builds.cmake_value import shown
from roslens.source.extract.facts.files import FolderFiles

ROOT = Path(__file__).parents[3] / "fixtures" / "extract" / "cmake"
SCRIPTS = sorted((ROOT / "language").glob("*.cmake"))


def messages(content):
    """Return what a script writes, and what of it is unresolved."""
    written = []

    def message(run, call):
        COMMANDS["message"](run, call)
        written.append("".join(call.arguments))

    commands = {**COMMANDS, "message": message}
    run = Evaluation("pkg", FolderFiles(ROOT, {}), ["pkg/CMakeLists.txt"], commands, IGNORED, BLOCKS)
    run.run_file("pkg/CMakeLists.txt", parse_cmake(content))
    return [shown(one) for one in written], [one.reason for one in run.unresolved]


@pytest.mark.parametrize("script", SCRIPTS, ids=[path.stem for path in SCRIPTS])
def test_scripts_write_what_cmake_writes(script):
    written, unresolved = messages(script.read_bytes())
    assert "\n".join(written).splitlines() == script.with_suffix(".expected").read_text().splitlines()
    assert not unresolved


@pytest.mark.real
@pytest.mark.skipif(shutil.which("cmake") is None, reason="cmake is not installed")
@pytest.mark.parametrize("script", SCRIPTS, ids=[path.stem for path in SCRIPTS])
def test_what_is_expected_is_what_cmake_writes(script):
    found = subprocess.run(["cmake", "-P", script], capture_output=True, text=True, check=True)
    assert found.stderr == script.with_suffix(".expected").read_text()


def test_both_branches_of_what_is_unknown():
    written, unresolved = messages(
        b"""
        set(NAME one)
        if(SOME_FOUND)
          message(found)
          set(NAME two)
          list(APPEND MORE a b)
        else()
          message(missing)
        endif()
        message("${NAME} ${MORE}")
        """
    )
    assert written[:2] == ["found", "missing"]
    assert written[2] == "{NAME depends on SOME_FOUND} {MORE depends on SOME_FOUND}"
    assert not unresolved


def test_what_is_usual_decides_where_the_user_may_say_otherwise():
    written, _ = messages(
        b"""
        option(WITH_X "x" OFF)
        if(WITH_X)
          set(NAME with)
        else()
          set(NAME without)
        endif()
        if(NOT DEFINED FOLDER)
          set(FOLDER here)
        endif()
        message("${NAME} ${FOLDER}")
        """
    )
    assert written == ["without here"]


def test_a_branch_that_fails_is_not_what_happens():
    written, _ = messages(b'if(X_FOUND)\nset(A 1)\nelse()\nmessage(FATAL_ERROR "no")\nendif()\nmessage("${A}")')
    assert written == ["1"]


@pytest.mark.parametrize(
    ("script", "reason"),
    [
        (b"foreach(x RANGE 100000)\nmessage(x)\nendforeach()", "too many iterations"),
        (b"while(TRUE)\nset(x 1)\nendwhile()", "too many iterations"),
        (b"function(f)\nf()\nendfunction()\nif(1)\nf()\nendif()", "deep"),
        (b"macro(f)\nf(${ARGV} a)\nendmacro()\nif(1)\nf(b)\nendif()", "deep"),
        (b"if(1)\n" * 10_000, "nested"),
    ],
    ids=["range", "while", "recursion", "macro", "nesting"],
)
def test_bounds(script, reason):
    written, unresolved = messages(script + b"\nmessage(end)")
    assert any(reason in one for one in unresolved)
    assert len(written) < 2000


def test_text_that_doubles():
    script = b"set(A 0123456789)\n" + b"set(A ${A}${A})\n" * 100 + b'message("${A}")'
    written, _ = messages(script)
    assert "too long" in written[0]
