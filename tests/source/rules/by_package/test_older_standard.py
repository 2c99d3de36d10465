"""What C++17 removed is a mistake in packages that are built with it."""

import pytest

from roslens.model.weight.consequence import Certainty
from roslens.source.rules.by_package.older_standard import as_notes_with_older_standard
from roslens.source.rules.hit import Hit

MANIFEST = "<package format='2'><name>p</name><buildtool_depend>catkin</buildtool_depend></package>"


@pytest.mark.parametrize(
    ("line", "is_note"),
    [
        ("set(CMAKE_CXX_STANDARD 14)", True),
        ("add_compile_options(-std=c++11)", True),
        ('set(CMAKE_CXX_FLAGS "-std=c++0x ${CMAKE_CXX_FLAGS}")', True),
        ("if(NOT CMAKE_CXX_STANDARD)\n  set(CMAKE_CXX_STANDARD 14)\nendif()", True),
        ("", True),
        ("target_compile_features(a PUBLIC cxx_std_14)", True),
        ("target_compile_features(a PUBLIC cxx_std_17)", False),
        ("set(CMAKE_CXX_STANDARD 17)\nadd_definitions(-std=c++11)", False),
        ("add_compile_options(-std=gnu++1z)", False),
        ("set(CMAKE_CXX_STANDARD ${STANDARD})", False),
    ],
)
def test_a_package_that_does_not_ask_for_the_newer_standard_has_notes(line, is_note, package_view, tmp_path):
    (tmp_path / "package.xml").write_text(MANIFEST)
    (tmp_path / "CMakeLists.txt").write_text(f"project(p)\n{line}\nadd_library(a a.cpp)\n")
    (tmp_path / "a.cpp").write_text("std::auto_ptr<int> p;\n")
    placed = {"a.cpp": [Hit("cpp.removed_library", "m", 1), Hit("cpp.guard", "m", 2)]}
    ((first, second),) = as_notes_with_older_standard(placed, package_view(tmp_path)).values()
    assert (first.certainty is Certainty.HEURISTIC) is is_note
    assert second.certainty is None


def test_what_was_removed_is_told_whatever_the_file(package_view, tmp_path):
    (tmp_path / "package.xml").write_text(MANIFEST)
    (tmp_path / "CMakeLists.txt").write_text("project(p)\nset(CMAKE_CXX_STANDARD 11)\n")
    (tmp_path / "a.hpp").write_text("void f() throw(int);\n")
    placed = {"a.hpp": [Hit("cpp.exception_specification", "m", 1)]}
    assert as_notes_with_older_standard(placed, package_view(tmp_path))["a.hpp"][0].certainty is Certainty.HEURISTIC


def test_packages_for_ros_2_are_built_with_the_newer_standard(package_view, tmp_path):
    export = "<export><build_type>ament_cmake</build_type></export>"
    (tmp_path / "package.xml").write_text(f"<package format='3'><name>p</name>{export}</package>")
    (tmp_path / "CMakeLists.txt").write_text("project(p)\nadd_library(a a.cpp)\n")
    placed = {"a.cpp": [Hit("cpp.removed_library", "m", 1)]}
    assert as_notes_with_older_standard(placed, package_view(tmp_path))["a.cpp"][0].certainty is None


def test_a_package_that_says_nothing_may_have_a_compiler_without_specifications(package_view, tmp_path):
    (tmp_path / "package.xml").write_text(MANIFEST)
    (tmp_path / "CMakeLists.txt").write_text("project(p)\nadd_library(a a.cpp)\n")
    placed = {"a.hpp": [Hit("cpp.exception_specification", "m", 1)]}
    assert as_notes_with_older_standard(placed, package_view(tmp_path))["a.hpp"][0].certainty is None
