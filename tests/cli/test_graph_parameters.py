"""``roslens graph`` on a package whose parameters generate_parameter_library declares: from its YAML to a finding."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
import yaml

from roslens.cli.main import main

FILES = {
    "package.xml": '<package format="3"><name>arm</name><version>1.0.0</version><description>d</description>'
    '<maintainer email="a@example.org">a</maintainer><license>MIT</license>'
    "<export><build_type>ament_cmake</build_type></export></package>",
    "CMakeLists.txt": "project(arm)\ngenerate_parameter_library(arm_parameters src/arm.yaml)\n"
    "add_executable(arm_node src/arm.cpp)\ntarget_link_libraries(arm_node arm_parameters)\n"
    "install(TARGETS arm_node DESTINATION lib/${PROJECT_NAME})\n",
    "src/arm.yaml": """\
arm:
  joints: {type: string_array, default_value: [], description: "To move", read_only: true}
  speed:
    type: double
    default_value: 0.5
    validation:
      bounds<>: [0.0, 1.0]
  out: {type: string, default_value: joint_states}
  gains:
    __map_joints:
      p: {type: double, default_value: 1.0}
""",
    "src/arm.cpp": """\
#include <rclcpp/rclcpp.hpp>
#include <sensor_msgs/msg/joint_state.hpp>
#include "arm/arm_parameters.hpp"
int main(int argc, char ** argv) {
  rclcpp::init(argc, argv);
  auto node = std::make_shared<rclcpp::Node>("arm");
  auto listener = std::make_shared<arm::ParamListener>(node);
  auto params = listener->get_params();
  auto pub = node->create_publisher<sensor_msgs::msg::JointState>(params.out, 10);
  rclcpp::spin(node);
}
""",
    "config/arm.yaml": """\
/**/arm:
  ros__parameters:
    joints: [left, right]
    speed: 1e1
    out: states
    gains: {left: {p: 2}, right: {p: 3.5}, middle: {p: 1.0}}
""",
    "launch/arm.launch.xml": '<launch><node pkg="arm" exec="arm_node" namespace="robot">'
    '<param from="$(find-pkg-share arm)/config/arm.yaml"/></node></launch>',
}


@pytest.fixture
def workspace(tmp_path: Path) -> str:
    for path, text in FILES.items():
        place = tmp_path / "arm" / path
        place.parent.mkdir(parents=True, exist_ok=True)
        place.write_text(text)
    return str(tmp_path)


def test_parameters_of_a_generated_library(capsys: pytest.CaptureFixture[str], workspace: str):
    assert main(["graph", workspace, "--launch", "arm/arm.launch.xml", "--format", "json"]) == 0
    ((node,),) = [one["nodes"] for one in json.loads(capsys.readouterr().out)["configurations"]]
    found = {one["name"]: one for one in node["parameters"]}
    speed = found["speed"]
    assert (speed["type"], speed["default"], speed["value"], speed["range"]) == ("double", "0.5", "1e1", "0.0..1.0")
    assert (speed["proof"]["path"], speed["proof"]["line"]) == ("arm/src/arm.yaml", 3)
    assert speed["proof"]["how"] == "declared by the ParamListener created at arm/src/arm.cpp:7"
    assert (found["joints"]["read_only"], found["joints"]["description"]) == (True, "To move")
    assert {name for name, one in found.items() if one.get("access") and name.startswith("gains")} == {
        "gains.left.p",
        "gains.right.p",
    }
    ends = {one["endpoint"]["name"] for one in node["endpoints"] if one["proof"].get("origin") != "implicit"}
    assert ends == {"/robot/states"}
    # The second time all of it comes out of the cache, and a change of the YAML is seen.
    (Path(workspace) / "arm" / "src" / "arm.yaml").write_text(FILES["src/arm.yaml"].replace("0.5", "0.25"))
    assert main(["graph", workspace, "--launch", "arm/arm.launch.xml", "--format", "nodl"]) == 0
    (document,) = yaml.safe_load_all(capsys.readouterr().out)
    assert document["parameters"]["speed"] == {
        "type": "double",
        "default_value": 0.25,
        "validation": {"bounds<>": [0.0, 1.0]},
    }


def test_what_does_not_fit_is_found(capsys: pytest.CaptureFixture[str], workspace: str):
    main(["graph", workspace, "--launch", "arm/arm.launch.xml", "--check"])
    out = capsys.readouterr().out
    assert "arm/config/arm.yaml:4: error: parameter `speed` of /robot/arm is set to `1e1`" in out
    assert "parameter `gains.left.p` of /robot/arm is set as int (`2`)" in out
    assert "parameter `gains.middle.p` is set for /robot/arm" in out
