"""What each tool printed when it looked at the sources of ``tests/fixtures/tool_output`` is what is reported."""

import re
import xml.etree.ElementTree as ET

import pytest
from recorded_tools import OUTPUT, ROOT, ended, request

from roslens.model.source import Language, Role, SourceFile
from roslens.source.tools.checks.tool_checks import checks_of, rule_of
from roslens.source.tools.clang_tidy import Build
from roslens.source.tools.running.run_tool import Ended, ToolError
from roslens.source.tools.table import tool_named
from roslens.source.tools.used import TOOLS

BESIDE = {"clang_tidy": Build({}, own_checks=False)}

FOUND = {
    "ruff": [
        ("old.py", 1, 7, "syntax-error"),
        ("sample.py", 1, 1, "I001"),
        ("sample.py", 1, 8, "F401"),
        ("sample.py", 2, 8, "F401"),
        ("sample.py", 2, 13, "F401"),
        ("sample.py", 3, 15, "B006"),
        ("sample.py", 5, 16, "F821"),
        ("sample.py", 6, 5, "E722"),
        ("sample.py", 6, 5, "S110"),
        ("sample.py", 9, 9, "F841"),
    ],
    "clang_format": [
        ("cat/src/cat.cpp", 1, 11, "violation"),
        ("sample.cpp", 1, 1, "violation"),
        ("sample.cpp", 4, 28, "violation"),
        ("sample.cpp", 7, 18, "violation"),
        ("sample.cpp", 11, 9, "violation"),
        ("sample.hpp", 5, 15, "violation"),
        ("sample.hpp", 10, 14, "violation"),
    ],
    "catkin_lint": [
        ("cat/CMakeLists.txt", 0, 0, "missing_cmd"),
        ("cat/CMakeLists.txt", 0, 0, "uninstalled_target"),
        ("cat/CMakeLists.txt", 0, 0, "unused_catkin_include_dirs"),
        ("cat/CMakeLists.txt", 1, 0, "cmake_ancient"),
        ("cat/CMakeLists.txt", 3, 0, "literal_project_name"),
        ("cat/CMakeLists.txt", 4, 0, "literal_project_name"),
        ("cat/CMakeLists.txt", 4, 0, "missing_file"),
        ("cat/CMakeLists.txt", 4, 0, "order_violation"),
        ("cat/CMakeLists.txt", 5, 0, "literal_project_name"),
        ("cat/CMakeLists.txt", 7, 0, "cmd_case"),
        ("cat/package.xml", 0, 0, "description_meaningless"),
    ],
    "ament_copyright": [
        ("cat/src/cat.cpp", 0, 0, "copyright"),
        ("old.py", 0, 0, "copyright"),
        ("sample.cpp", 0, 0, "copyright"),
        ("sample.hpp", 0, 0, "copyright"),
        ("sample.py", 0, 0, "copyright"),
    ],
    "ament_flake8": [
        ("old.py", 1, 2, "E999"),
        ("sample.py", 1, 1, "F401"),
        ("sample.py", 2, 1, "F401"),
        ("sample.py", 2, 1, "F401"),
        ("sample.py", 2, 11, "E401"),
        ("sample.py", 3, 1, "E302"),
        ("sample.py", 3, 26, "E251"),
        ("sample.py", 3, 28, "E251"),
        ("sample.py", 5, 16, "F821"),
        ("sample.py", 6, 5, "E722"),
        ("sample.py", 8, 13, "E711"),
        ("sample.py", 9, 9, "F841"),
        ("sample.py", 10, 1, "E302"),
    ],
    "ament_pep257": [
        ("old.py", 0, 0, "unknown"),
        ("sample.py", 12, 0, "D400"),
        ("sample.py", 12, 0, "D403"),
        ("sample.py", 12, 0, "D415"),
    ],
    "ament_lint_cmake": [
        ("cat/CMakeLists.txt", 6, 0, "whitespace/extra"),
        ("cat/CMakeLists.txt", 7, 0, "readability/mixedcase"),
        ("cat/CMakeLists.txt", 7, 0, "whitespace/extra"),
    ],
    "ament_xmllint": [],
    "cpplint": [
        ("cat/src/cat.cpp", 0, 0, "legal/copyright"),
        ("sample.cpp", 0, 0, "legal/copyright"),
        ("sample.cpp", 1, 0, "build/include_subdir"),
        ("sample.cpp", 13, 0, "runtime/printf"),
        ("sample.hpp", 0, 0, "legal/copyright"),
        ("sample.hpp", 4, 0, "build/namespaces"),
        ("sample.hpp", 7, 0, "runtime/explicit"),
        ("sample.hpp", 9, 0, "build/include_what_you_use"),
        ("sample.hpp", 10, 0, "readability/casting"),
        ("sample.hpp", 10, 0, "runtime/int"),
        ("sample.hpp", 10, 0, "whitespace/tab"),
    ],
    "cppcheck": [
        ("sample.cpp", 4, 33, "unusedVariable"),
        ("sample.cpp", 4, 47, "selfAssignment"),
        ("sample.cpp", 10, 8, "constVariablePointer"),
        ("sample.cpp", 14, 3, "memleak"),
        ("sample.cpp", 14, 10, "uninitdata"),
        ("sample.cpp", 14, 14, "arrayIndexOutOfBounds"),
        ("sample.cpp", 14, 18, "zerodiv"),
        ("sample.hpp", 7, 3, "noExplicitConstructor"),
        ("sample.hpp", 9, 20, "unusedStructMember"),
        ("sample.hpp", 10, 8, "unusedStructMember"),
        ("whole.cpp", 2, 3, "noExplicitConstructor"),
        ("whole.cpp", 9, 12, "zerodiv"),
    ],
    "pylint": [
        ("old.py", 1, 2, "syntax-error"),
        ("sample.py", 1, 1, "unused-import"),
        ("sample.py", 2, 1, "unused-import"),
        ("sample.py", 2, 1, "unused-import"),
        ("sample.py", 3, 1, "dangerous-default-value"),
        ("sample.py", 3, 9, "unused-argument"),
        ("sample.py", 5, 16, "undefined-variable"),
        ("sample.py", 6, 5, "bare-except"),
        ("sample.py", 9, 9, "unused-variable"),
    ],
    "clang_tidy": [
        ("sample.cpp", 0, 0, "not-compiled"),
        ("whole.cpp", 8, 9, "bugprone-suspicious-semicolon"),
        ("whole.cpp", 9, 12, "clang-analyzer-core.DivideZero"),
    ],
}


def called(name):
    """Return the recorded call: exit code and files."""
    _, code, files = (OUTPUT / name / "call.txt").read_text().splitlines()
    return int(code.rpartition(" ")[2]), files.split()[1:]


def read(name):
    tool = tool_named(name)
    code, files = called(name)
    given = {"packages": {"cat": "cat"}, "scratch": str(OUTPUT / name), "beside": BESIDE.get(name)}
    return tool.read(tool.checked(ended(tool, code)), request(tool, files, **given))


@pytest.mark.parametrize("name", TOOLS)
def test_findings(name):
    assert [(one.path, one.line, one.column, one.check) for one in sorted(read(name).findings)] == FOUND[name]


@pytest.mark.parametrize("name", TOOLS)
def test_every_file_was_looked_at(name):
    skipped = read(name).skipped
    assert skipped == ({"gone.cpp": "Can't open for reading"} if name == "cpplint" else {})


@pytest.mark.parametrize("name", TOOLS)
@pytest.mark.parametrize(
    "output", [b"", b"Traceback (most recent call last):\nKeyError\n", b"\x00\xff\x07" * 99, b"<a>"]
)
def test_whatever_else_it_prints_is_no_clean_bill(name, output, tmp_path):
    tool = tool_named(name)
    (tmp_path / "result.xml").write_bytes(output)
    given = {"packages": {}, "scratch": str(tmp_path), "beside": BESIDE.get(name)}
    files = [file for file in called(name)[1] if file != "gone.cpp"]
    if name == "clang_tidy" and not output:
        return  # it prints nothing where it finds nothing; its exit code and what it says of failures count
    code = max(tool.clean_codes - {31}) if name != "clang_tidy" else 1
    with pytest.raises(ToolError):
        tool.read(tool.checked(Ended(code, output, output)), request(tool, files, **given))


@pytest.mark.parametrize("name", TOOLS)
def test_it_says_what_a_user_wants_to_know(name):
    tool = tool_named(name)
    assert tool.name == name
    assert tool.text.endswith(".")
    assert tool.get
    assert {Language(one) for one in tool.languages}
    assert checks_of(name).about.startswith("https://")
    assert tool.manifest.needs == (f"program:{tool.program}",)
    kind = Language(tool.languages[0])
    assert tool.reads(SourceFile("a/package.xml", kind))
    assert not tool.reads(SourceFile("a/package.xml", kind, Role.VENDORED))


@pytest.mark.parametrize("name", TOOLS)
def test_what_it_found_is_mapped(name):
    for check in {check for *_, check in FOUND[name]}:
        known = checks_of(name).of(check)
        assert known.tags, check
        rule = rule_of(name, check)
        assert rule.id == f"{name}.{check}"
        assert rule.url.startswith("https://")


STANDARDS = (
    r"misra-cpp-2008 \d+-\d+-\d+|misra-cpp-2023 \d+\.\d+\.\d+|hicpp \d+\.\d+\.\d+|jsf-av \d+"
    r"|autosar-cpp14 [AM]\d+-\d+-\d+|google [\w.+-]+|ros-style [\w-]+"
)


@pytest.mark.parametrize("name", TOOLS)
def test_clauses_are_of_standards(name):
    for check, known in checks_of(name).checks.items():
        for clause in known.clauses:
            assert re.fullmatch(STANDARDS, clause), f"{check}: {clause}"


def test_the_addon_of_cppcheck_for_misra(tmp_path):
    tool = tool_named("cppcheck")
    call = request(tool, ["old.c"], options={"misra": True}, group="c", scratch=str(tmp_path))
    assert "--addon=misra" in tool.words(call)
    found = tool.read(Ended(0, b"", (OUTPUT / "cppcheck" / "misra").read_bytes()), call).findings
    assert {one.check for one in found} >= {"misra-c2012-15.5", "misra-c2012-15.6"}
    assert "misra-c-2012" in rule_of("cppcheck", "misra-c2012-15.5").tags
    cpp = request(tool, ["a.cpp"], options={"misra": True}, group="cpp", scratch=str(tmp_path))
    assert "--addon=misra" not in tool.words(cpp)


def test_cppcheck_is_told_of_the_macros_of_ros(tmp_path):
    tool = tool_named("cppcheck")
    words = tool.words(request(tool, ["a.cpp"], scratch=str(tmp_path)))
    (library,) = [word.partition("=")[2] for word in words if word.startswith("--library=")]
    names = {one.get("name") for one in ET.parse(library).getroot()}
    assert {"PLUGINLIB_EXPORT_CLASS(a,b)", "RCLCPP_COMPONENTS_REGISTER_NODE(a)"} <= names


def test_an_addon_that_does_not_run_is_no_clean_bill():
    tool = tool_named("cppcheck")
    error = b'<error id="internalError" severity="error" msg="Failed to execute addon"/>'
    reported = b'<results version="2"><errors>' + error + b"</errors></results>"
    with pytest.raises(ToolError, match="cannot run its addon"):
        tool.read(Ended(0, b"", reported), request(tool, ["old.c"]))


def test_pylint_leaves_out_what_has_its_names_from_elsewhere():
    tool = tool_named("pylint")
    assert tool.reads(SourceFile("a/b.py", Language.PYTHON))
    assert not tool.reads(SourceFile("a/cfg/b.cfg", Language.PYTHON))


def test_catkin_lint_passes_over_packages_of_others():
    tool = tool_named("catkin_lint")
    reported = Ended(0, b"", b"catkin_lint: no packages to check\n")
    assert tool.read(reported, request(tool, ["am/package.xml"])).findings == ()


def test_clang_tidy_without_checks_says_so():
    tool = tool_named("clang_tidy")
    with pytest.raises(ToolError, match="has no checks to run"):
        tool.read(Ended(1, b"", b"Error: no checks enabled.\n"), request(tool, ["a.cpp"], beside=BESIDE["clang_tidy"]))


def test_names_that_look_like_options_are_none(tmp_path):
    for name in TOOLS:
        if name != "clang_tidy":
            tool = tool_named(name)
            call = request(tool, ["-rm.cpp", "-x/package.xml"], scratch=str(tmp_path), packages={})
            assert not [word for word in tool.words(call) if word.startswith(("-rm", "-x"))], name
    assert ROOT.startswith("/")
