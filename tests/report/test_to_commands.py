import shlex

from roslens.model.configuration import Configuration, ConfiguredNode, ConfiguredParameter, ConfiguredRemap, Proof
from roslens.report.graph.to_commands import to_commands

_PLACE = Proof("a.launch.py", 3)


def _lines(*nodes, generation="ros2"):
    return to_commands(Configuration("a.launch.py", generation, nodes)).splitlines()[1:]


def _set(name, value, kind):
    return ConfiguredParameter(name, value, kind, set_type=kind, set_by=_PLACE)


def test_a_node_is_started_with_its_name_remappings_and_parameters():
    node = ConfiguredNode(
        "/rover/base", _PLACE, package="rover_base", executable="base_node",
        remaps=(ConfiguredRemap("cmd_vel", "/cmd", _PLACE),),
        parameters=(_set("port", "5", "string"), ConfiguredParameter("rate", "1", "int", "1")),
    )  # fmt: skip
    (line,) = _lines(node)
    assert shlex.split(line) == [
        "ros2", "run", "rover_base", "base_node", "--ros-args", "-r", "__node:=base", "-r", "__ns:=/rover",
        "-r", "cmd_vel:=/cmd", "-p", 'port:="5"',
    ]  # fmt: skip


def test_a_component_is_loaded_after_its_container_runs():
    box = ConfiguredNode(
        "/z_box", Proof("z.launch.py", 9), package="rclcpp_components", executable="component_container"
    )
    part = ConfiguredNode("/cam", _PLACE, package="cams", executable="cams::Cam", kind="component", container="/z_box")
    first, second = _lines(part, box)
    assert first == "ros2 run rclcpp_components component_container --ros-args -r __node:=z_box"
    assert second == "ros2 component load /z_box cams cams::Cam --node-name cam"


def test_two_nodes_of_one_program_keep_their_names():
    nodes = [
        ConfiguredNode(name, _PLACE, package="p", executable="both", parameters=(_set("rate", "2", "int"),))
        for name in ("/a", "/b")
    ]
    assert _lines(*nodes) == ["ros2 run p both --ros-args -p a:rate:=2 -p b:rate:=2"]


def test_what_cannot_be_stated_is_a_comment():
    lacking = ConfiguredParameter("robot_description", None, set_type="string", set_by=_PLACE)
    node = ConfiguredNode("/rsp", _PLACE, package="p", executable="rsp", parameters=(lacking,), conditions=("use_rsp",))
    process = ConfiguredNode("/x", Proof("b.launch.py", 1), executable="gazebo", kind="process")
    assert _lines(node, process) == [
        "# /rsp: only if use_rsp",
        "# /rsp: parameter robot_description is not in the line: its value is known only while it runs",
        "ros2 run p rsp --ros-args -r __node:=rsp",
        "# /x: what starts it is no program of a package (b.launch.py:1)",
    ]


def test_ros_1_is_started_by_rosrun():
    node = ConfiguredNode(
        "/rover/base", _PLACE, package="rover_base", executable="base_node",
        remaps=(ConfiguredRemap("cmd_vel", "/cmd", _PLACE),), parameters=(_set("/rover/base/rate", "1", "int"),),
    )  # fmt: skip
    assert _lines(node, generation="ros1") == [
        "rosrun rover_base base_node __name:=base __ns:=/rover cmd_vel:=/cmd _rate:=1"
    ]
