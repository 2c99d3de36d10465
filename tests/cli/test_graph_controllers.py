"""Controllers of ROS 1 in the node whose code has their manager, by types that stand below no node."""

import pytest

from roslens.cli.graph.graph_source import GraphSource
from roslens.source.settings import SourceSettings

FILES = {
    "package.xml": """<package><name>arm</name><buildtool_depend>catkin</buildtool_depend>
<export><controller_interface plugin="${prefix}/plugins.xml"/></export></package>""",
    "CMakeLists.txt": """
project(arm)
find_package(catkin REQUIRED)
add_library(state src/state.cpp)
add_executable(arm_node src/main.cpp)
""",
    "plugins.xml": """<library path="lib/libstate">
  <class name="arm/State" type="arm::State" base_class_type="controller_interface::ControllerBase"/>
</library>""",
    "src/main.cpp": """
#include <ros/ros.h>
#include <controller_manager/controller_manager.h>
int main(int argc, char ** argv) {
  ros::init(argc, argv, "arm"); ros::NodeHandle nh; Hardware hardware;
  controller_manager::ControllerManager manager(&hardware, nh);
  ros::spin();
}
""",
    "src/state.cpp": """
#include <ros/ros.h>
#include <controller_interface/controller.h>
namespace arm {
class State : public controller_interface::Controller<hardware_interface::JointStateInterface> { public:
  bool init(hardware_interface::JointStateInterface * hw, ros::NodeHandle & nh) {
    pub_ = nh.advertise<std_msgs::String>("state", 1);
    return true;
  }
  ros::Publisher pub_; };
}
PLUGINLIB_EXPORT_CLASS(arm::State, controller_interface::ControllerBase)
""",
    "config/controllers.yaml": """
state_controller:
  type: arm/State
joints:
  type: joint_state_controller/JointStateController
never_spawned:
  type: arm/State
lost:
  type: other/Lost
""",
    "launch/arm.launch": """<launch>
  <rosparam command="load" file="$(find arm)/config/controllers.yaml"/>
  <node pkg="arm" type="arm_node" name="arm"/>
  <node pkg="controller_manager" type="spawner" name="spawner" args="state_controller joints lost"/>
</launch>""",
}


@pytest.fixture
def launched(tmp_path):
    for name, text in FILES.items():
        path = tmp_path / "arm" / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text.lstrip())
    with GraphSource(str(tmp_path), SourceSettings(), "roslens.toml", {}) as source:
        return source.launched("arm/arm.launch", {})


def test_a_manager_in_code_has_what_is_spawned(launched):
    (arm,) = [node for node in launched.nodes if node.name == "/arm"]
    made = {end.endpoint.name: (end.endpoint.type, end.proof) for end in arm.endpoints if not end.implicit}
    assert made["/state_controller/state"][0] == "std_msgs/String"
    proof = made["/state_controller/state"][1]
    assert (proof.path, proof.sure) == ("arm/src/state.cpp", "likely")
    assert "spawned at arm/launch/arm.launch:4" in proof.how
    assert "/joint_states" in made
    assert "/controller_manager/load_controller" in made
    assert not [name for name in made if name.startswith("/never_spawned")]


def test_what_nobody_knows_is_said(launched):
    reported = {one.text: one.reason for one in launched.unresolved}
    assert reported["controller lost"].startswith("other/Lost is not a known controller")
    assert "controller state_controller" not in reported
    assert "controller joints" not in reported
