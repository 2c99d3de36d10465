"""Code that makes endpoints and that no known program starts is shown: by package, likely at most, never dropped."""

import json

import pytest

from roslens.cli.main import main

MANIFEST = """<package format="2"><name>{name}</name><version>1.0.0</version><description>d</description>
<maintainer email="a@b.org">a</maintainer><license>MIT</license><buildtool_depend>catkin</buildtool_depend>
<depend>roscpp</depend><export>{exports}</export></package>"""
CMAKE = "project({name})\nfind_package(catkin REQUIRED)\ncatkin_package()\n"
HEAD = "#include <ros/ros.h>\n#include <std_msgs/String.h>\n"
TALK = (
    HEAD
    + """int main(int argc, char ** argv) {
  ros::init(argc, argv, "talk");
  ros::NodeHandle nh;
  ros::Publisher pub = nh.advertise<std_msgs::String>("chatter", 1);
}
"""
)
EYE = (
    HEAD
    + """class Eye {
public:
  explicit Eye(ros::NodeHandle & nh) { pub_ = nh.advertise<std_msgs::String>("seen", 1); }
  void look() { ros::NodeHandle nh("~"); sub_ = nh.subscribe("light", 1, &Eye::on, this); }
  void on(const std_msgs::String::ConstPtr & msg) {}
  ros::Publisher pub_;
  ros::Subscriber sub_;
};
"""
)
PLUGIN = (
    HEAD
    + """#include <pluginlib/class_list_macros.h>
class Layer : public outer::Base {
  void onInitialize() { ros::NodeHandle nh; sub_ = nh.subscribe("people", 1, &Layer::on, this); }
  void on(const std_msgs::String::ConstPtr & msg) {}
  ros::Subscriber sub_;
};
PLUGINLIB_EXPORT_CLASS(Layer, outer::Base)
"""
)
DESCRIPTION = """<library path="lib/liblayer"><class name="p/People" type="Layer" base_class_type="outer::Base">
<description>d</description></class></library>"""
SCRIPT = """#!/usr/bin/env python
import rospy
from std_msgs.msg import String
if __name__ == '__main__':
    rospy.init_node('loose')
    rospy.Publisher('from_script', String, queue_size=1)
"""
FACTORY = (
    HEAD
    + """class Node::Impl {
public:
  Impl() { ros::NodeHandle nh; pub_ = nh.advertise<std_msgs::String>("of_impl", 1); }
  ros::Publisher pub_;
};
"""
)
MAIN_OF_FACTORY = (
    HEAD
    + """#include "node.h"
int main(int argc, char ** argv) { ros::init(argc, argv, "factory"); auto node = outer::make(); ros::spin(); }
"""
)


LAUNCH = """<launch>
  <node pkg="outer" type="host" name="host"><rosparam>{layers: [{name: a, type: p/People}]}</rosparam></node>
  <node pkg="outer" type="other" name="other"/>
</launch>"""


def launched(root, capsys, *words):
    """Return the endpoints of each node that a launch file starts, with how they came to be known."""
    main(["graph", str(root), "--no-cache", "-q", "--format", "json", "--launch", "p/a.launch", *words])
    (answer,) = json.loads(capsys.readouterr().out)["configurations"]
    return {
        node["name"]: [(end["endpoint"]["name"], end["proof"]) for end in node.get("endpoints", ())]
        for node in answer["nodes"]
    }


def test_a_plug_in_is_joined_where_a_parameter_of_a_launch_file_names_it(told, tmp_path, capsys):
    files = {"src/layer.cpp": PLUGIN, "layer.xml": DESCRIPTION, "launch/a.launch": LAUNCH}
    told(files, "add_library(layer src/layer.cpp)", '<outer plugin="${prefix}/layer.xml"/>')
    found = launched(tmp_path, capsys)
    ((name, proof),) = found["/host"]
    assert (name, proof["path"], proof["sure"]) == ("/people", "p/src/layer.cpp", "likely")
    assert "parameter /host/layers names the plug-in p/People" in proof["how"]
    assert found["/other"] == []


@pytest.mark.parametrize("code", ["Eye", "p/src/eye.cpp"])
def test_code_is_joined_where_a_hint_says_so(told, tmp_path, capsys, code):
    (tmp_path / "roslens.toml").write_text(f'[graph.hints."/host"]\nloads = ["{code}"]\n')
    told({"src/eye.cpp": EYE, "launch/a.launch": LAUNCH}, "add_library(eye src/eye.cpp)")
    found = launched(tmp_path, capsys, "--config", str(tmp_path / "roslens.toml"))
    assert [name for name, _ in found["/host"]] == ["/seen", "/host/light"]
    assert {proof["sure"] for _, proof in found["/host"]} == {"likely"}
    assert all("is loaded according to" in proof["how"] for _, proof in found["/host"])


@pytest.fixture
def told(tmp_path, capsys):
    """Return what the command says of a package with these files, as JSON and as text."""

    def make(files, cmake="", exports=""):
        all_files = {
            "package.xml": MANIFEST.format(name="p", exports=exports),
            "CMakeLists.txt": CMAKE.format(name="p") + cmake,
            **files,
        }
        for path, text in all_files.items():
            (tmp_path / "p" / path).parent.mkdir(parents=True, exist_ok=True)
            (tmp_path / "p" / path).write_text(text)
        assert main(["graph", str(tmp_path), "--no-cache", "-q", "--format", "json"]) == 0
        answer = json.loads(capsys.readouterr().out)["configurations"]
        assert main(["graph", str(tmp_path), "--no-cache", "-q"]) == 0
        return answer, capsys.readouterr().out

    return make


def loose(answer):
    """Return what nothing starts: kind, unit, and its endpoints with how sure they are."""
    return [
        (
            node["kind"],
            node["unit"],
            [(end["endpoint"]["name"], end["proof"].get("sure", "certain")) for end in node.get("endpoints", ())],
        )
        for one in answer
        if one.get("unstarted")
        for node in one["nodes"]
    ]


def test_a_class_of_a_library(told):
    answer, text = told(
        {"src/talk.cpp": TALK, "src/eye.cpp": EYE}, "add_executable(talk src/talk.cpp)\nadd_library(eye src/eye.cpp)"
    )
    assert loose(answer) == [("library", "Eye", [("/seen", "likely"), ("/*/light", "possible")])]
    started = next(one for one in answer if not one.get("unstarted"))
    assert [end["endpoint"]["name"] for end in started["nodes"][0]["endpoints"]] == ["/chatter"]
    assert "created by libraries, plug-ins and scripts that no known program starts: ros1, 2 endpoints" in text
    assert "  library Eye  p/src/eye.cpp:3" in text


def test_what_a_program_uses_is_shown_there_alone(told):
    used = TALK.replace("ros::Publisher pub", "Eye eye(nh); eye.look();\n  ros::Publisher pub").replace(
        HEAD, HEAD + '#include "eye.h"\n'
    )
    answer, text = told({"src/talk.cpp": used, "src/eye.h": EYE}, "add_executable(talk src/talk.cpp)")
    assert loose(answer) == []
    assert "no known program" not in text


def test_a_plug_in_with_the_name_by_which_it_is_loaded(told):
    answer, text = told(
        {"src/layer.cpp": PLUGIN, "layer.xml": DESCRIPTION},
        "add_library(layer src/layer.cpp)",
        '<outer plugin="${prefix}/layer.xml"/>',
    )
    assert loose(answer) == [("plugin", "Layer", [("/people", "likely")])]
    assert "plugin Layer, loaded as p/People in p/layer.xml:1" in text


def test_a_controller_has_its_names_in_its_own_namespace(told):
    code = (
        HEAD
        + """#include <pluginlib/class_list_macros.h>
class Arm : public controller_interface::Controller<hardware_interface::EffortJointInterface> {
  bool init(hardware_interface::EffortJointInterface * hw, ros::NodeHandle & root_nh, ros::NodeHandle & n) {
    state_ = n.advertise<std_msgs::String>("state", 1);
    all_ = root_nh.advertise<std_msgs::String>("all", 1);
    return true;
  }
  ros::Publisher state_, all_;
};
PLUGINLIB_EXPORT_CLASS(Arm, controller_interface::ControllerBase)
"""
    )
    answer, _ = told({"src/arm.cpp": code}, "add_library(arm src/arm.cpp)")
    assert [ends for _, _, ends in loose(answer)] == [[("*/state", "possible"), ("/all", "likely")]]


@pytest.mark.parametrize("name", ["scripts/loose.py", "bin/loose"])
def test_a_script_that_nothing_installs(told, name):
    answer, _ = told({name: SCRIPT})
    assert loose(answer) == [("script", "<module>", [("/from_script", "likely")])]


def test_a_program_that_no_build_makes(told):
    answer, _ = told({"src/talk.cpp": TALK})
    assert loose(answer) == [("program", "main", [("/chatter", "likely")])]


def test_what_an_outer_factory_makes(told):
    answer, _ = told(
        {"src/impl.cpp": FACTORY, "src/main.cpp": MAIN_OF_FACTORY}, "add_executable(factory src/main.cpp src/impl.cpp)"
    )
    assert loose(answer) == [("library", "Node.Impl", [("/of_impl", "likely")])]


def test_functions_and_templates_that_nothing_calls(told):
    functions = (
        HEAD
        + """
void start(ros::NodeHandle & nh) { static ros::Publisher pub = nh.advertise<std_msgs::String>("started", 1); }
template <class T> ros::Publisher offer(ros::NodeHandle & nh, std::string name) { return nh.advertise<T>(name, 1); }
"""
    )
    answer, _ = told({"src/functions.cpp": functions}, "add_library(functions src/functions.cpp)")
    assert loose(answer) == [("library", "start", [("/started", "likely")]), ("library", "offer", [("*", "possible")])]


def test_members_of_a_base_outside_of_the_workspace(told):
    code = (
        HEAD
        + """class Panel : public outer::Panel {
  void onInitialize() {
    pub_ = nh_.advertise<std_msgs::String>("pressed", 1);
    client_ = create_client<std_srvs::srv::Trigger>("ask");
  }
};
"""
    )
    answer, _ = told({"src/panel.cpp": code}, "add_library(panel src/panel.cpp)")
    assert loose(answer) == [("library", "Panel", [("/pressed", "likely"), ("/ask", "likely")])]


def test_a_way_that_nothing_took(told):
    code = (
        HEAD
        + """class Door : public outer::Controller {
public:
  Door() : loud_(false) {}
  bool init(ros::NodeHandle & nh) {
    if (loud_) { pub_ = nh.advertise<std_msgs::String>("knock", 1); }
    return true;
  }
  bool loud_;
  ros::Publisher pub_;
};
"""
    )
    answer, _ = told({"src/door.cpp": code}, "add_library(door src/door.cpp)")
    assert loose(answer) == [("library", "Door.init", [("/knock", "likely")])]


def test_a_call_of_which_nothing_came_is_unresolved_at_its_line(told):
    code = (
        "import rospy\nimport outer\ndef begin():\n    for one in outer.all():\n        one.subscribe('x', one.kind)\n"
    )
    answer, _ = told({"src/p/code.py": code, "src/talk.cpp": TALK}, "add_executable(talk src/talk.cpp)")
    places = {
        (end["proof"]["path"], end["proof"]["line"])
        for one in answer
        for node in one["nodes"]
        for end in node.get("endpoints", ())
    }
    missed = {(two["proof"]["path"], two["proof"]["line"]) for one in answer for two in one.get("unresolved", ())}
    assert ("p/src/p/code.py", 5) in places | missed


def test_files_outside_of_packages_are_no_exception(tmp_path, capsys):
    (tmp_path / "alone.py").write_text(SCRIPT)
    assert main(["graph", str(tmp_path), "--no-cache", "-q", "--format", "json"]) == 0
    answer = json.loads(capsys.readouterr().out)["configurations"]
    assert loose(answer) == [("script", "<module>", [("/from_script", "likely")])]


def test_vendored_code_comes_last_and_in_one_line(told):
    files = {
        "src/eye.cpp": EYE,
        "third_party/other/other.cpp": EYE.replace("Eye", "Other"),
        "third_party/other/LICENSE": "MIT",
    }
    answer, text = told(files, "add_library(eye src/eye.cpp third_party/other/other.cpp)")
    assert {unit for _, unit, _ in loose(answer)} == {"Eye", "Other"}
    assert "Other" not in text
    assert "and 2 endpoints of vendored, generated or test code, listed by --format json" in text
