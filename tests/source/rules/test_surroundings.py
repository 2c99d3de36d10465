"""What rules say of one package for what others of the workspace are to it."""

import pytest

from roslens.model.finding import Severity
from roslens.source.rules.package_findings import rule_findings
from roslens.source.settings import RuleSettings

MANIFEST = "<package format='3'><name>{}</name>{}<export><build_type>{}</build_type></export></package>"
PLUGINS = "pluginlib_export_plugin_description_file(nav plugins.xml)\n"
START = '<launch><param name="ns" value="$(arg name)"/></launch>'
WHOLE = (
    '<launch><arg name="name" default="a"/><include file="$(find p)/launch/one.launch" pass_all_args="{}"/></launch>'
)


def package(folder, name, asks="", kind="ament_cmake", **files):
    (folder / name / "launch").mkdir(parents=True)
    (folder / name / "package.xml").write_text(MANIFEST.format(name, asks, kind))
    for path, text in files.items():
        where = folder / name / path.replace("__", "/").replace("_dot_", ".")
        where.parent.mkdir(exist_ok=True)
        where.write_text(text)


def found(rule, view):
    failures = []
    severities = [one.severity for one in rule_findings(view, RuleSettings((), (rule,)), {}, (), (), failures)]
    assert not failures
    return severities


@pytest.mark.parametrize(
    ("plugins", "asks", "severity"),
    [
        (PLUGINS, "", Severity.NOTE),
        (PLUGINS, "<depend>p</depend>", Severity.WARNING),
        (PLUGINS, "<exec_depend>p</exec_depend>", Severity.NOTE),
        ("", "", Severity.WARNING),
        ("add_executable(a a.cpp)\n", "", Severity.NOTE),
        ("add_executable(a a.cpp)\n", "<depend>p</depend>", Severity.WARNING),
        ("add_library(a a.cpp)\nament_export_libraries(a)\n", "", Severity.WARNING),
    ],
)
def test_headers_that_nobody_is_built_with_need_not_be_installed(plugins, asks, severity, package_view, tmp_path):
    build = f"project(p)\n{plugins}ament_export_include_directories(include)\nament_package()\n"
    package(tmp_path, "p", CMakeLists_dot_txt=build, include__a_dot_hpp="int a;\n")
    package(tmp_path, "q", asks)
    assert found("cmake.header_not_installed", package_view(tmp_path, "p")) == [severity]


@pytest.mark.parametrize(
    ("asks", "passes", "severities"),
    [
        ("<depend>p</depend>", "true", []),
        ("<depend>p</depend>", "false", [Severity.WARNING]),
        ("", "true", [Severity.NOTE]),
    ],
)
def test_a_package_that_depends_on_it_may_pass_all_arguments(asks, passes, severities, package_view, tmp_path):
    package(tmp_path, "p", kind="catkin", launch__one_dot_launch=START)
    package(tmp_path, "q", asks, "catkin", launch__all_dot_launch=WHOLE.format(passes))
    assert found("launch.undeclared_argument", package_view(tmp_path, "p")) == severities


@pytest.mark.parametrize(
    ("path", "text", "severity"),
    [
        ("start.sh", "roslaunch p one.launch name:=b\n", Severity.NOTE),
        ("README.md", "Run `roslaunch p one.launch rate:=3 name:=b`.\n", Severity.NOTE),
        ("p/start.sh", "roslaunch p one.launch \\\n  name:=b\n", Severity.NOTE),
        ("start.sh", "roslaunch p other.launch name:=b\n", Severity.NOTE),
        ("start.sh", "roslaunch p one.launch rate:=3\nroslaunch q other.launch name:=b\n", Severity.WARNING),
        ("start.sh", "roslaunch p one.launch other_name:=b\n", Severity.WARNING),
    ],
)
def test_a_script_may_give_an_argument(path, text, severity, package_view, tmp_path):
    package(tmp_path, "p", kind="catkin", launch__one_dot_launch=START, launch__half_dot_launch=WHOLE.format("false"))
    package(tmp_path, "q")
    (tmp_path / path).write_text(text)
    assert found("launch.undeclared_argument", package_view(tmp_path, "p")) == [severity]


@pytest.mark.parametrize(("given", "severities"), [('<arg name="name" value="a"/>', []), ("", [Severity.WARNING])])
def test_a_default_that_is_the_argument_itself_needs_a_file_that_gives_it(given, severities, package_view, tmp_path):
    itself = '<launch><arg name="name" default="$(arg name)"/><param name="ns" value="$(arg name)"/></launch>'
    includes = f'<launch><include file="$(find p)/launch/one.launch">{given}</include></launch>'
    package(tmp_path, "p", kind="catkin", launch__one_dot_launch=itself, launch__all_dot_launch=includes)
    assert found("launch.undeclared_argument", package_view(tmp_path, "p")) == severities


NEEDS = '<launch><node pkg="q" {}="go" name="go"/></launch>'


@pytest.mark.parametrize(
    ("kind", "asks", "severity"),
    [
        ("ament_cmake", "", Severity.WARNING),
        ("ament_cmake", "<exec_depend>p</exec_depend>", Severity.NOTE),
        ("ament_cmake", "<depend>between</depend>", Severity.NOTE),
        ("ament_cmake", "<doc_depend>p</doc_depend>", Severity.WARNING),
        # catkin orders packages that need each other only when they run.
        ("catkin", "<exec_depend>p</exec_depend>", Severity.WARNING),
        ("catkin", "<build_depend>p</build_depend>", Severity.NOTE),
    ],
)
def test_a_dependency_that_would_close_a_cycle_is_not_expected(kind, asks, severity, package_view, tmp_path):
    start = NEEDS.format("exec" if kind.startswith("ament") else "type")
    package(tmp_path, "p", kind=kind, launch__one_dot_launch=start)
    package(tmp_path, "between", "<depend>p</depend>", kind)
    package(tmp_path, "q", asks, kind)
    assert found("package.undeclared_dependency", package_view(tmp_path, "p")) == [severity]


def test_it_says_which_of_two_packages_declares_the_other(package_view, tmp_path):
    package(tmp_path, "p", launch__one_dot_launch=NEEDS.format("exec"))
    package(tmp_path, "q", "<exec_depend>p</exec_depend>")
    settings = RuleSettings((), ("package.undeclared_dependency",))
    (one,) = rule_findings(package_view(tmp_path, "p"), settings, {}, (), (), [])
    assert one.message.startswith(
        "launch file launch/one.launch: 'p' uses 'q' without declaring it, and package.xml of 'q' declares 'p': "
    )
    assert not one.edits
