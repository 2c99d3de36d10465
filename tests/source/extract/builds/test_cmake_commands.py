"""Commands that set variables, read files and look for things."""

import pytest

from roslens.source.extract.builds.cmake_blocks import BLOCKS
from roslens.source.extract.builds.cmake_commands import COMMANDS, IGNORED
from roslens.source.extract.builds.cmake_evaluation import Evaluation
from roslens.source.extract.builds.cmake_files import matching
from roslens.source.extract.builds.cmake_syntax import parse_cmake
from roslens.source.extract.builds.cmake_value import shown


class Written:
    def __init__(self, files):
        self.files = files

    def package(self, name):
        return name if f"{name}/package.xml" in self.files else None

    def content(self, path):
        return self.files.get(path)


def run(text, **more):
    files = {path.replace("__", "/"): content for path, content in more.items()}
    files |= more.get("files", {})
    files = {path: content for path, content in files.items() if isinstance(content, bytes)}
    found = Evaluation(
        "pkg", Written(files), [one for one in files if one.startswith("pkg/")], COMMANDS, IGNORED, BLOCKS
    )
    found.variables.set("CMAKE_CURRENT_SOURCE_DIR", found.absolute("pkg"))
    found.run_file("pkg/CMakeLists.txt", parse_cmake(text.encode()))
    return found


def reasons(found):
    return [one.reason for one in found.unresolved]


def test_project():
    found = run("project(robot VERSION 1.2)")
    assert found.variables.get("PROJECT_NAME") == "robot"
    assert found.variables.get("robot_VERSION") == "1.2"
    assert found.variables.get("CATKIN_PACKAGE_BIN_DESTINATION") == "lib/robot"
    assert found.variables.get("PROJECT_SOURCE_DIR") == found.absolute("pkg")


def test_subfolders_have_a_scope():
    found = run(
        "set(A 1)\nadd_subdirectory(sub)\nadd_subdirectory(gone)",
        files={
            "pkg/sub/CMakeLists.txt": b"set(A 2)\nset(B ${A} PARENT_SCOPE)\n"
            b"set(C ${CMAKE_CURRENT_SOURCE_DIR} PARENT_SCOPE)"
        },
    )
    assert (found.variables.get("A"), found.variables.get("B"), found.variables.get("C")) == (
        "1",
        "2",
        found.absolute("pkg/sub"),
    )
    assert reasons(found) == ['"pkg/gone/CMakeLists.txt" is not among the files of the package']


def test_a_folder_that_adds_itself():
    found = run(
        "add_subdirectory(sub)\nset(B 1)", files={"pkg/sub/CMakeLists.txt": b"if(1)\nadd_subdirectory(../sub)\nendif()"}
    )
    assert reasons(found) == ["the folder is added twice"]
    assert found.variables.get("B") == "1"


def test_included_files():
    found = run(
        "include(cmake/a.cmake)\ninclude(gone.cmake)\ninclude(nowhere.cmake OPTIONAL)\ninclude(CheckIncludeFile)\n"
        "list(APPEND CMAKE_MODULE_PATH ${CMAKE_CURRENT_LIST_DIR}/cmake)\ninclude(Mine)",
        files={"pkg/cmake/a.cmake": b"set(A ${CMAKE_CURRENT_LIST_DIR})", "pkg/cmake/Mine.cmake": b"set(M 1)"},
    )
    assert found.variables.get("A") == found.absolute("pkg/cmake")
    assert found.variables.get("M") == "1"
    assert reasons(found) == ["the included file is not in the workspace"]


def test_packages_of_the_workspace_give_functions():
    files = {
        "tools/package.xml": b"",
        "tools/CMakeLists.txt": b'ament_package(CONFIG_EXTRAS "tools-extras.cmake" DEPENDS x)',
        "tools/tools-extras.cmake": b'include("${tools_DIR}/more.cmake")',
        "tools/cmake/more.cmake": b"macro(tell name)\nset(${name} told)\nendmacro()",
        "old/package.xml": b"",
        "old/CMakeLists.txt": b"if(1)\ncatkin_package(\n  CFG_EXTRAS old.cmake\n)\nendif()",
        "old/cmake/old.cmake.em": b"@[if DEVELSPACE]@\nset(OLD 1)\n@[end if]@\n",
    }
    found = run("find_package(tools REQUIRED)\nfind_package(catkin REQUIRED COMPONENTS old)\ntell(X)", files=files)
    assert found.variables.get("X") == "told"
    assert found.variables.get("OLD") == "1"
    assert found.variables.get("tools_FOUND") == "1"
    assert not found.unresolved


def test_globs():
    files = {f"pkg/{path}": b"" for path in ("b.cpp", "a.cpp", "a.hpp", "src/c.cpp", "src/deep/d.cpp", "src/x[1].cpp")}
    found = run(
        "file(GLOB A *.cpp)\nfile(GLOB B RELATIVE ${CMAKE_CURRENT_SOURCE_DIR} src/*.cpp [ab].hpp)\n"
        "file(GLOB_RECURSE C RELATIVE ${CMAKE_CURRENT_SOURCE_DIR} CONFIGURE_DEPENDS src/*.cpp)",
        files=files,
    )
    assert found.variables.get("A") == ";".join(found.absolute(f"pkg/{one}.cpp") for one in "ab")
    assert found.variables.get("B") == "a.hpp;src/c.cpp;src/x[1].cpp"
    assert found.variables.get("C") == "src/c.cpp;src/deep/d.cpp;src/x[1].cpp"


def test_a_pattern_of_many_stars_ends_soon():
    names = frozenset(f"pkg/{'a' * 250}{number}" for number in range(20))
    assert matching("pkg/" + "*a" * 90 + "b", names, frozenset(), deep=False) == []


def test_what_only_the_build_knows_is_unknown():
    found = run(
        "find_library(LIB x)\ncheck_include_file(x.h HAVE)\nget_property(P TARGET x PROPERTY y)\nfile(READ f CONTENT)\n"
        'qt5_wrap_cpp(MOC a.h)\nset(A "${LIB}|${HAVE}|${P}|${CONTENT}|${MOC}")'
    )
    assert shown(found.variables.get("A")).count("{") == 5


@pytest.mark.parametrize(
    ("expression", "value"),
    [("1 + 2 * 3", "7"), ("7 / 2", "3"), ("8 % 5", "3"), ("2 ** 9", None), ("x", None), ("1/0", None)],
)
def test_math(expression, value):
    found = run(f'math(EXPR R "{expression}")').variables.get("R")
    assert found == value or (value is None and "number" in shown(found))
