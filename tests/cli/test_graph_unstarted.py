"""What no known program starts: below a launch file, in pictures and pages, and at the nodes that it belongs to."""

import json

import pytest

from roslens.cli.graph.graph_linked import with_linked
from roslens.cli.graph.graph_source import GraphSource
from roslens.cli.main import main
from roslens.source.settings import SourceSettings

FILES = {
    "worker/package.xml": "<package><name>worker</name><buildtool_depend>catkin</buildtool_depend></package>",
    "worker/CMakeLists.txt": """
project(worker)
find_package(catkin REQUIRED COMPONENTS roscpp)
add_library(impl src/impl.cpp)
add_executable(worker_node src/main.cpp)
target_link_libraries(worker_node impl)
add_executable(other_node src/other.cpp)
""",
    "worker/src/impl.cpp": """
#include <ros/ros.h>
class Impl { public:
  void run() { pub_ = nh_.advertise<std_msgs::String>("made_in_secret", 1); }
  ros::NodeHandle nh_; ros::Publisher pub_; };
""",
    "worker/src/main.cpp": """
#include <ros/ros.h>
#include <outside/factory.h>
int main(int argc, char ** argv) { ros::init(argc, argv, "worker"); outside::create("Impl")->start(); }
""",
    "worker/src/other.cpp": """
#include <ros/ros.h>
int main(int argc, char ** argv) { ros::init(argc, argv, "other"); ros::NodeHandle nh; ros::spin(); }
""",
    "worker/launch/all.launch": """
<launch>
  <node pkg="worker" type="worker_node" name="worker"/><node pkg="worker" type="other_node" name="other"/>
</launch>
""",
    "apart/package.xml": "<package><name>apart</name><buildtool_depend>catkin</buildtool_depend></package>",
    "apart/CMakeLists.txt": "project(apart)\nfind_package(catkin REQUIRED)\nadd_library(apart src/apart.cpp)\n",
    "apart/src/apart.cpp": """
#include <ros/ros.h>
void apart(ros::NodeHandle & nh) { static auto pub = nh.advertise<std_msgs::String>("apart", 1); }
""",
}


@pytest.fixture
def workspace(tmp_path):
    for name, text in FILES.items():
        path = tmp_path / "ws" / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text.lstrip())
    return tmp_path / "ws"


def names(configurations):
    return [end.endpoint.name for one in configurations for node in one.nodes for end in node.endpoints]


def test_a_launch_file_has_the_libraries_of_the_packages_that_it_starts(workspace, capsys):
    with GraphSource(str(workspace), SourceSettings(), "roslens.toml", {}) as source:
        launched = source.launched("worker/all.launch", {})
        found = source.unstarted_beside(launched)
        assert names(found) == ["/made_in_secret"]
        (linked,) = with_linked((launched,), found, source.facts)
    assert {node.name: [one.path for one in node.linked] for node in linked.nodes} == {
        "/worker": ["worker/src/impl.cpp"],
        "/other": [],
    }
    assert main(["graph", str(workspace), "--launch", "worker/all.launch", "--no-cache"]) == 0
    text = capsys.readouterr().out
    assert "it may create those that no known program starts: worker/src/impl.cpp:2" in text
    assert "/apart" not in text


@pytest.mark.parametrize("form", ["dot", "svg"])
def test_pictures_list_it_and_draw_no_node(workspace, capsys, form):
    assert main(["graph", str(workspace), "--format", form, "--no-cache"]) == 0
    text = capsys.readouterr().out
    assert "code of a library that no known program uses" in text
    assert "publishes /made_in_secret" in text
    assert "publishes /apart" in text
    drawn = '"topic /made_in_secret"' if form == "dot" else "<title>topic /made_in_secret"
    assert drawn not in text


def test_pages_have_it_by_package(workspace, tmp_path, capsys):
    assert main(["check", str(workspace), "-q", "--jobs", "1", "--graph", "--fail-on", "never"]) == 0
    assert main(["report", str(workspace), "-q", "-o", str(tmp_path / "out")]) == 0
    capsys.readouterr()
    page = json.loads((tmp_path / "out/computation/all.launch.json").read_text())
    assert [one["name"] for one in page["elements"] if one["kind"] == "node"] == ["/other", "/worker"]
    found = {(row["package"], row["name"], row["reason"]) for row in page["tables"]["unstarted"]["rows"]}
    reason = "code of a library that no known program uses"
    assert found == {("apart", "/apart", reason), ("worker", "/made_in_secret", reason)}
    assert "Started by no known program" in (tmp_path / "out/computation/all.launch.html").read_text()
    package = json.loads((tmp_path / "out/packages/apart.json").read_text())
    assert [row["name"] for row in package["tables"]["unstarted"]["rows"]] == ["/apart"]
    assert "made_in_secret" in (tmp_path / "out/packages/worker.html").read_text()


def test_one_file_of_a_launch_file_lists_it(workspace, tmp_path):
    out = tmp_path / "one.html"
    assert main(["graph", str(workspace), "--launch", "worker/all.launch", "--no-cache", "--html", str(out)]) == 0
    assert "made_in_secret" in out.read_text()


def test_what_is_in_no_package_has_no_disc(workspace, tmp_path):
    (workspace / "tool.py").write_text("import rospy\n\n\ndef run():\n    return 1\n")
    assert main(["check", str(workspace), "-q", "--jobs", "1", "--fail-on", "never"]) == 0
    assert main(["report", str(workspace), "-q", "--no-graph", "-o", str(tmp_path / "out")]) == 0
    graph = json.loads((tmp_path / "out/graph.json").read_text())
    assert [node["id"] for node in graph["graph"]["nodes"]] == ["apart", "worker"]
    assert len(graph["values"]) == 2


def test_options_that_choose_a_node_leave_it_out(workspace, capsys):
    assert main(["graph", str(workspace), "--node", "/other", "--no-cache"]) == 0
    assert "made_in_secret" not in capsys.readouterr().out
