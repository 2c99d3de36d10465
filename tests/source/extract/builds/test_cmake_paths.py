"""Paths as texts; the right answers are what cmake 3.25 gives."""

import pytest

from roslens.source.extract.builds.cmake_blocks import BLOCKS
from roslens.source.extract.builds.cmake_commands import COMMANDS, IGNORED
from roslens.source.extract.builds.cmake_evaluation import SOURCE, Evaluation
from roslens.source.extract.builds.cmake_syntax import parse_cmake
from roslens.source.extract.builds.cmake_value import hole, is_unknown


class Nothing:
    def content(self, _path):
        return None

    def package(self, _name):
        return None


def after(text, **first):
    run = Evaluation("pkg", Nothing(), ["pkg/src/b.cpp", "pkg/src/a.c", "pkg/src/x/y.cpp", "pkg/src/h.hpp"], COMMANDS,
                     IGNORED, BLOCKS)  # fmt: skip
    for name, value in first.items():
        run.variables.set(name, value)
    run.run_file("pkg/CMakeLists.txt", parse_cmake(text.encode()))
    return run


@pytest.mark.parametrize(
    ("path", "mode", "value"),
    [
        ("a.b.tar.gz", "NAME_WE", "a"), ("a.b.tar.gz", "EXT", ".b.tar.gz"), ("a.b.tar.gz", "LAST_EXT", ".gz"),
        ("a.b.tar.gz", "NAME_WLE", "a.b.tar"), ("dir/", "NAME", ""), ("dir/", "DIRECTORY", ""), ("a/b/", "PATH", "a"),
        (".hid", "NAME_WLE", ""), ("../up", "ABSOLUTE BASE_DIR /base/x", "/base/up"),
        ("/x/y/", "REALPATH", "/x/y"), ("src/../a", "ABSOLUTE", f"{SOURCE}/pkg/a"),
    ],
)  # fmt: skip
def test_components(path, mode, value):
    assert after(f'get_filename_component(R "{path}" {mode})').variables.get("R") == value


@pytest.mark.parametrize(
    ("command", "value"),
    [
        ("cmake_path(GET P FILENAME R)", "b.tar.gz"), ("cmake_path(GET P STEM R)", "b"),
        ("cmake_path(GET P EXTENSION LAST_ONLY R)", ".gz"), ("cmake_path(GET P PARENT_PATH R)", "a"),
        ("cmake_path(APPEND P x y OUTPUT_VARIABLE R)", "a/b.tar.gz/x/y"), ("cmake_path(HAS_EXTENSION P R)", "ON"),
        ("cmake_path(IS_ABSOLUTE P R)", "OFF"), ("cmake_path(SET R NORMALIZE x/./y/../z/)", "x/z/"),
        ("cmake_path(ABSOLUTE_PATH P OUTPUT_VARIABLE R)", f"{SOURCE}/pkg/a/b.tar.gz"),
        ("cmake_path(REMOVE_FILENAME P OUTPUT_VARIABLE R)", "a/"),
    ],
)  # fmt: skip
def test_paths(command, value):
    found = after(command, P="a/b.tar.gz")
    assert (found.variables.get("R"), found.variables.get("P")) == (value, "a/b.tar.gz")


@pytest.mark.parametrize(
    ("name", "short", "long"),
    [
        ("..", ".|", "..|"), (".", ".|", ".|"), ("....", ".|...", "...|."), (".a.b", ".a|.b", ".a|.b"),
        ("..a", ".|.a", ".|.a"), ("a.", "a|.", "a|."), ("a..", "a|..", "a.|."), ("...a", ".|..a", "..|.a"),
    ],
)  # fmt: skip
def test_names_of_dots(name, short, long):
    for last, expected in (("", short), (" LAST_ONLY", long)):
        found = after(f"cmake_path(GET P STEM{last} S)\ncmake_path(GET P EXTENSION{last} E)", P=f"x/{name}")
        assert f"{found.variables.get('S')}|{found.variables.get('E')}" == expected
    has = "ON" if short.partition("|")[2] else "OFF"
    assert after("cmake_path(HAS_EXTENSION P R)", P=f"x/{name}").variables.get("R") == has


@pytest.mark.parametrize(
    ("path", "more", "value"),
    [
        ("x//y", "a//b", "x/y/a/b"),
        ("//x//y", "a", "/x/y/a"),
        ("x/y//", '""', "x/y/"),
        ("x//", "/a", "/a"),
        ("", "a/", "a/"),
    ],
)
def test_what_is_appended_to(path, more, value):
    assert after(f"cmake_path(APPEND P {more})", P=path).variables.get("P") == value
    assert is_unknown(after(f"cmake_path(APPEND P {more})", P="//").variables.get("P"))


def test_what_is_not_evaluated_is_unknown_where_it_is_put():
    found = after("cmake_path(NATIVE_PATH P R)\ncmake_path(RELATIVE_PATH P BASE_DIRECTORY /x)", P="a", R="old")
    assert is_unknown(found.variables.get("R"))
    assert is_unknown(found.variables.get("P"))
    assert is_unknown(after("cmake_path(GET P STEM R)", P=hole("x")).variables.get("R"))


def test_sources_of_a_folder():
    assert after("aux_source_directory(src L)", L="z.cpp").variables.get("L") == "z.cpp;src/a.c;src/b.cpp"
