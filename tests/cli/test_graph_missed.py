"""What was not understood of builds is reported where there are nodes too, in short."""

import json

import pytest

from roslens.cli.graph.graph_missed import reported_by_file, reported_once
from roslens.cli.main import main
from roslens.source.extract.facts.launched import Unresolved
from roslens.source.extract.facts.node_facts import Evidence

PACKAGE = """<package format="3"><name>p</name><version>1.0.0</version><description>d</description>
<maintainer email="a@example.org">a</maintainer><license>MIT</license><depend>rclcpp</depend>
<export><build_type>ament_cmake</build_type></export></package>"""
CMAKE = """cmake_minimum_required(VERSION 3.8)
project(p)
add_executable(talk talk.cpp)
make_more(a)
make_more(b)
wrap_all()
install(TARGETS talk DESTINATION lib/p)
"""
TALK = """#include <rclcpp/rclcpp.hpp>
int main(int argc, char ** argv) {
  rclcpp::init(argc, argv);
  rclcpp::spin(std::make_shared<rclcpp::Node>("talk"));
}
"""


@pytest.fixture
def workspace(tmp_path):
    (tmp_path / "p").mkdir()
    for name, text in (("package.xml", PACKAGE), ("CMakeLists.txt", CMAKE), ("talk.cpp", TALK)):
        (tmp_path / "p" / name).write_text(text)
    return tmp_path


def test_text_and_json_tell_it(workspace, capsys):
    assert main(["graph", str(workspace)]) == 0
    out = capsys.readouterr().out
    assert "unresolved: 2\n" in out
    assert "p/CMakeLists.txt:4" in out
    assert 'the command is not defined in the workspace; and in 1 more place "make_more()"' in out
    assert 'p/CMakeLists.txt:6  the command is not defined in the workspace "wrap_all()"' in out
    assert main(["graph", str(workspace), "--format", "json"]) == 0
    (reported,) = json.loads(capsys.readouterr().out)["configurations"]
    assert [(one["text"], one["proof"]["line"]) for one in reported["unresolved"]] == [
        ("make_more()", 4),
        ("wrap_all()", 6),
    ]


def test_one_node_alone_is_not_drowned(workspace, capsys):
    assert main(["graph", str(workspace), "--node", "talk"]) == 0
    assert "unresolved" not in capsys.readouterr().out


def test_what_is_the_same_is_told_once():
    missed = [Unresolved("f()", Evidence("b/C.txt", line), "why") for line in (9, 3, 3, 5)]
    (one, other) = reported_once([*missed, Unresolved("g()", Evidence("b/C.txt", 1), "why")])
    assert (one.evidence.line, one.reason) == (3, "why; and in 2 more places")
    assert other.reason == "why"


def test_what_is_the_same_in_a_file_is_told_once():
    missed = [Unresolved(text, Evidence("b/c.cpp", line), "why") for text, line in (("f()", 9), ("g()", 3), ("h()", 3))]
    others = [
        Unresolved("f()", Evidence("b/c.cpp", 1), "another reason"),
        Unresolved("f()", Evidence("b/d.cpp", 1), "why"),
    ]
    (one, *rest) = reported_by_file([*missed, *others])
    assert (one.text, one.evidence.line, one.reason) == ("g()", 3, "why; and 2 more in this file")
    assert rest == others


def test_code_is_told_that_is_not_understood_or_never_called(workspace, capsys):
    (workspace / "p" / "more.cpp").write_text(
        "#include <rclcpp/rclcpp.hpp>\n"
        'void later(rclcpp::Node & node) { node.create_publisher<std_msgs::msg::Bool>("done", 1); }\n'
    )
    (workspace / "p" / "odd.cpp").write_text("int odd( { ;\n")
    assert main(["graph", str(workspace)]) == 0
    out = capsys.readouterr().out
    assert "  library later  p/more.cpp:2" in out
    assert "p/odd.cpp:1  this part of the file could not be parsed" in out


def test_of_what_a_launch_file_starts_it_is_told_too(workspace, capsys):
    (workspace / "p" / "launch").mkdir()
    (workspace / "p" / "launch" / "a.launch.xml").write_text('<launch><node pkg="p" exec="talk"/></launch>')
    (workspace / "p" / "talk.cpp").write_text(
        TALK
        + 'void later(rclcpp::Node & node) { node.create_publisher<std_msgs::msg::Bool>("done", 1); }\nint odd( { ;\n'
    )
    assert main(["graph", str(workspace), "--launch", "p/a.launch.xml"]) == 0
    out = capsys.readouterr().out
    assert "p/talk.cpp:6  this function creates endpoints" in out
    assert "this part of the file could not be parsed" in out


@pytest.mark.parametrize("nodes", ["talk", ""])
def test_packages_that_a_marker_leaves_out_are_named(workspace, capsys, nodes):
    for path in ("old/q/package.xml", "install/p/package.xml"):
        (workspace / path).parent.mkdir(parents=True)
        (workspace / path).write_text(PACKAGE.replace("<name>p<", "<name>q<"))
    (workspace / "old/COLCON_IGNORE").touch()
    (workspace / "install/COLCON_IGNORE").touch()
    (workspace / "empty").mkdir()
    (workspace / "empty/CATKIN_IGNORE").touch()
    if not nodes:
        (workspace / "p/CMakeLists.txt").write_text("project(p)\n")
    assert main(["graph", str(workspace), "--format", "json"]) == (0 if nodes else 3)
    found = [one for graph in json.loads(capsys.readouterr().out)["configurations"] for one in graph["unresolved"]]
    ((text, place, reason),) = {
        (one["text"], one["proof"]["path"], one["reason"]) for one in found if "IGNORE" in str(one)
    }
    assert (text, place) == ("old", "old/COLCON_IGNORE")
    assert reason == "its packages are left out because of this file"
    main(["graph", str(workspace), "--package", "p", "--format", "json"])
    assert "COLCON_IGNORE" not in capsys.readouterr().out
