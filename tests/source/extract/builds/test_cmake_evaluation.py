"""Variables, paths, functions and limits of an evaluation."""

import pytest

from roslens.source.extract.builds.cmake_blocks import BLOCKS
from roslens.source.extract.builds.cmake_commands import COMMANDS, IGNORED
from roslens.source.extract.builds.cmake_evaluation import SOURCE, Evaluation
from roslens.source.extract.builds.cmake_syntax import parse_cmake
from roslens.source.extract.builds.cmake_value import hole, is_unknown, shown


class Written:
    def __init__(self, files):
        self.files = files

    def package(self, name):
        return name if f"{name}/package.xml" in self.files else None

    def content(self, path):
        return self.files.get(path)


def evaluation(files=None, **commands):
    files = files or {}
    listing = [path for path in files if path.startswith("pkg/")]
    return Evaluation("pkg", Written(files), listing, {**COMMANDS, **commands}, IGNORED, BLOCKS)


def run(text, evaluated=None):
    evaluated = evaluated or evaluation()
    evaluated.run_file("pkg/CMakeLists.txt", parse_cmake(text.encode()))
    return evaluated


def test_what_others_may_have_set_is_unknown():
    found = run('find_package(Foo)\nset(A "${Foo_LIBS} ${FOO_X} ${CMAKE_BUILD_TYPE} ${bar_FOUND}")\nset(B "${plain}")')
    assert shown(found.variables.get("A")).count("build environment") == 4
    assert found.variables.get("B") == ""


def test_what_a_package_sets_itself_is_known():
    assert run("set(Foo_LIBS x)\nfind_package(Foo)\nset(A ${Foo_LIBS})").variables.get("A") == "x"


def test_unknown_commands_may_set_what_they_name():
    found = run('wrap(OUT in.ui)\nset(A "${OUT}")')
    assert is_unknown(found.variables.get("A"))
    assert [one.reason for one in found.unresolved] == ["the command is not defined in the workspace"]


def test_paths():
    found = evaluation({"pkg/src/a.cpp": b""})
    assert found.relative("src/a.cpp") == "pkg/src/a.cpp"
    assert found.relative("../other/b.cpp") == "other/b.cpp"
    assert found.relative(f"{SOURCE}/pkg/./src/../c") == "pkg/c"
    assert found.relative("/usr/include") is None
    assert found.relative(hole("x")) is None
    assert found.exists("src", folder=True) is True
    assert found.exists("src/a.cpp", folder=True) is False
    assert found.exists("src/b.cpp", folder=False) is False
    assert found.exists("/usr", folder=True) is None


def test_the_place_of_what_a_function_does_is_the_call():
    seen = []
    found = evaluation(mark=lambda _, call: seen.append((call.evidence.line, call.evidence.how)))
    run("function(f)\nmark()\nendfunction()\nfunction(g)\nf()\nendfunction()\nmark()\ng()\n", found)
    assert seen == [(7, "written"), (8, "by g()")]


def test_a_loop_over_what_is_unknown_goes_over_what_it_may_be():
    seen = []
    found = evaluation(mark=lambda one, call: seen.append((call.arguments, [*one.conditions])))
    run("set(L a)\nif(X_FOUND)\nlist(APPEND L b c)\nendif()\nforeach(i ${L})\nmark(${i})\nendforeach()", found)
    assert seen == [(["a"], []), (["b"], ["L depends on X_FOUND"]), (["c"], ["L depends on X_FOUND"])]


def test_conditions_are_kept_while_a_branch_is_run():
    seen = []
    found = evaluation(mark=lambda one, call: seen.append([*one.conditions]))
    run(
        "if(A_FOUND AND NOT B)\nmark()\nelseif(WIN32)\nmark()\nelse()\n"
        "if(NOT DEFINED SOME_VERSION)\nmark()\nendif()\nmark()\nendif()\nmark()",
        found,
    )
    denied = "NOT (A_FOUND AND NOT B)"
    assert seen == [["A_FOUND AND NOT B"], [denied, "NOT DEFINED SOME_VERSION"], [denied], []]


def test_what_a_function_sets_outside_in_a_branch_is_either():
    found = run("function(f)\nif(X_FOUND)\nset(R 1 PARENT_SCOPE)\nendif()\nendfunction()\nset(R 0)\nf()")
    assert shown(found.variables.get("R")) == "{R depends on X_FOUND}"


def test_what_follows_a_macro_that_calls_itself_is_read():
    found = run("macro(again)\n  again()\nendmacro()\nset(A 1)\nagain()\nset(B 2)")
    assert (found.variables.get("A"), found.variables.get("B")) == ("1", "2")
    (told,) = found.unresolved
    assert (told.text, told.evidence.line) == ("again()", 5)
    assert "nested more than 40 deep" in told.reason


def test_a_block_has_variables_of_its_own():
    found = run("set(a 1)\nset(b 1)\nblock(PROPAGATE b)\nset(a 2)\nset(b 2)\nset(c 2 PARENT_SCOPE)\nendblock()")
    assert [found.variables.get(name) for name in "abc"] == ["1", "2", "2"]
    assert run("set(a 1)\nblock(SCOPE_FOR POLICIES)\nset(a 2)\nendblock()").variables.get("a") == "2"


def test_return_gives_variables_to_the_caller():
    found = run("function(f)\nset(a 1)\nblock()\nset(b 2)\nreturn(PROPAGATE a b)\nendblock()\nendfunction()\nf()")
    assert (found.variables.get("a"), found.variables.get("b")) == ("1", "2")


def test_what_is_set_for_the_caller_is_not_seen_here():
    found = run("set(a 1)\nfunction(f)\nset(a 2 PARENT_SCOPE)\nset(b ${a} PARENT_SCOPE)\nendfunction()\nf()")
    assert (found.variables.get("a"), found.variables.get("b")) == ("2", "1")


def test_lists_are_gone_through_at_once():
    found = run('set(x 1 2)\nset(y a)\nforeach(i j IN ZIP_LISTS x y)\nstring(APPEND r "${i}${j},")\nendforeach()')
    assert found.variables.get("r") == "1a,2,"
    assert (
        run('set(x 1 2)\nforeach(i IN ZIP_LISTS x x)\nstring(APPEND r "${i_0}${i_1}")\nendforeach()').variables.get("r")
        == "1122"
    )


def test_a_loop_that_is_not_gone_through_leaves_what_it_sets_unknown():
    found = run("set(a 1)\nset(b 1)\nforeach(i RANGE 0 999999)\nset(a ${i})\nendforeach()")
    assert is_unknown(found.variables.get("a"))
    assert found.variables.get("b") == "1"
    assert found.unresolved


def test_arguments_of_macros_are_read_once_more():
    found = run('set(v 7)\nmacro(m p)\nset(r "${p}")\nset(s "${A${v}}")\nendmacro()\nm([[<${v}>]])')
    assert found.variables.get("r") == "<7>"


def test_commands_that_run_what_they_are_given():
    seen = []
    found = evaluation(mark=lambda _, call: seen.append((call.arguments, call.evidence.line)))
    run('\ncmake_language(CALL mark a "b;c")\ncmake_language(EVAL CODE "\n\n\nmark(${x}d)\nset(v 1)")', found)
    assert seen == [(["a", "b;c"], 2), (["d"], 3)]
    assert found.variables.get("v") == "1"
    run("cmake_language(DEFER CALL mark late)", found)
    assert [one.text for one in found.unresolved] == ["cmake_language(DEFER)"]


def test_a_variable_that_is_unset_uncovers_the_cache():
    found = run(
        'set(a kept CACHE STRING "")\nset(a 1)\nunset(a)\nset(b x CACHE INTERNAL "")\nset(b y CACHE STRING "" FORCE)'
    )
    assert (found.variables.get("a"), found.variables.get("b")) == ("kept", "y")


def test_what_follows_a_return_that_may_be_is_under_its_condition():
    seen = []
    found = evaluation(mark=lambda one, call: seen.append((call.arguments[0], [*one.conditions])))
    run(
        "function(f)\nif(X_FOUND)\nreturn()\nendif()\nmark(in)\nendfunction()\nf()\nmark(out)\n"
        "foreach(i 1 2)\nif(Y_FOUND)\nif(Z_FOUND)\ncontinue()\nendif()\nendif()\nmark(${i})\nendforeach()\nmark(end)",
        found,
    )
    loop = ["NOT (Y_FOUND)"]
    run("if(NOT W_FOUND)\nreturn()\nendif()\nmark(found)", found)
    assert seen.pop() == ("found", ["W_FOUND"])
    assert seen == [("in", ["NOT (X_FOUND)"]), ("out", []), ("1", loop), ("2", loop), ("end", [])]


def test_what_is_matched_is_forgotten_at_the_next_match():
    found = run('string(REGEX MATCH "(a)(b)" x ab)\nstring(REGEX MATCH "(c)" y c)\nif(ab MATCHES "(z)")\nendif()')
    assert [found.variables.get(f"CMAKE_MATCH_{at}") for at in (0, 1, 2, "COUNT")] == ["", "", "", "0"]


def test_an_unknown_command_may_change_what_is_set_before_and_named_first():
    assert is_unknown(run('set(OUT old)\nwrap(OUT in.ui)\nset(A "${OUT}")').variables.get("A"))


@pytest.mark.parametrize("call", ["wrap(a SOURCES b.cpp)", "wrap(${SOURCES})", "wrap()", "wrap(old)"])
def test_further_words_of_an_unknown_command_are_keywords_of_its_own(call):
    assert run(f"set(SOURCES old)\n{call}").variables.get("SOURCES") == "old"


@pytest.mark.xfail(strict=True, reason="an unknown command is told, but its words are as often keywords as variables")
def test_an_unknown_command_may_change_what_is_set_before_and_named_later():
    assert is_unknown(run("set(OUT old)\nwrap(in.ui OUT)").variables.get("OUT"))
