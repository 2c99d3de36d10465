"""``roslens graph --check`` tells parameters that a launch file of ROS 1 sets in another namespace than code reads."""

import json

import pytest

from roslens.cli.main import main

MANIFEST = """<package><name>talk</name><version>1.0.0</version><description>d</description>
<maintainer email="a@example.org">a</maintainer><license>MIT</license>
<buildtool_depend>catkin</buildtool_depend><run_depend>rospy</run_depend></package>"""
PYTHON = """#!/usr/bin/env python
import rospy
from std_msgs.msg import String

rospy.init_node("talker")
rate = rospy.get_param("{name}", 5)
publisher = rospy.Publisher("chatter", String, queue_size=1)
"""
CPP = """#include <ros/ros.h>
#include <std_msgs/String.h>
int main(int argc, char ** argv) {
  ros::init(argc, argv, "talker");
  ros::NodeHandle handle(HANDLE);
  int rate;
  handle.param("rate", rate, 5);
  ros::Publisher publisher = handle.advertise<std_msgs::String>("chatter", 1);
}
"""
CMAKE = """cmake_minimum_required(VERSION 3.0)
project(talk)
find_package(catkin REQUIRED COMPONENTS roscpp std_msgs)
catkin_package()
add_executable(talk_cpp src/talk.cpp)
"""
INSIDE = '<launch><node pkg="talk" type="{type}" name="talker"><param name="rate" value="1"/></node></launch>'
OUTSIDE = '<launch><param name="rate" value="1"/><node pkg="talk" type="{type}" name="talker"/></launch>'


def reported(folder, launch, kind, code, capsys):
    """Return rule, severity and entity of what is reported of the parameter."""
    source = f"{'src' if kind == 'talk_cpp' else 'scripts'}/{code[0]}"
    files = {
        "package.xml": MANIFEST, "CMakeLists.txt": CMAKE, source: code[1],
        "launch/talk.launch": launch.format(type=kind),
    }  # fmt: skip
    for path, text in files.items():
        place = folder / "talk" / path
        place.parent.mkdir(parents=True, exist_ok=True)
        place.write_text(text)
    main(
        [
            "graph",
            str(folder),
            "--launch",
            "talk/talk.launch",
            "--check",
            "--format",
            "json",
            "--fail-on",
            "never",
            "-q",
        ]
    )
    rows = json.loads(capsys.readouterr().out)
    return [(one["rule"], one["severity"], one["entity"]) for one in rows if "parameter" in one["rule"]]


@pytest.mark.parametrize(
    ("launch", "python", "cpp", "entity"),
    [
        (INSIDE, "/rate", "", "parameter:/talker:/talker/rate"),
        (INSIDE, "rate", "", "parameter:/talker:/talker/rate"),
        (OUTSIDE, "~rate", '"~"', "parameter:/talker:/rate"),
        (INSIDE, "~rate", '"~"', ""),
        (OUTSIDE, "/rate", "", ""),
        (OUTSIDE, "rate", "", ""),
    ],
)
def test_where_it_is_set_and_where_it_is_read(launch, python, cpp, entity, tmp_path, capsys):
    wanted = [("graph.parameter_namespace", "warning", entity)] if entity else []
    script = ("talk.py", PYTHON.format(name=python))
    assert reported(tmp_path / "python", launch, "talk.py", script, capsys) == wanted
    program = ("talk.cpp", CPP.replace("(HANDLE)", f"({cpp})" if cpp else ""))
    assert reported(tmp_path / "cpp", launch, "talk_cpp", program, capsys) == wanted
