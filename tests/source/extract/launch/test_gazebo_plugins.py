import pytest

from roslens.source.extract.catalogue.hints import ROLES, endpoint_of
from roslens.source.extract.facts.node_facts import Evidence
from roslens.source.extract.launch.gazebo_plugins import plugins
from roslens.source.extract.launch.launch_ros1 import evaluate_ros1
from roslens.source.extract.symbolic.condition import as_written

SPAWN = '<node pkg="gazebo_ros" type="spawn_model" name="spawn" args="-urdf -param robot_description -model m"/>'
DESCRIBE = '<param name="robot_description" command="xacro \'$(find robot)/r.xacro\' ns:=/"/>'


class Written:
    """A launch file and a description that are written in the test."""

    def __init__(self, launch, description):
        self.files = {
            "a.launch": f"<launch>{launch}</launch>",
            "robot/r.xacro": f'<robot xmlns:xacro="x"><xacro:arg name="ns" default="/b"/>{description}</robot>',
        }

    def package(self, name):
        return "robot" if name == "robot" else None

    def content(self, path):
        text = self.files.get(path)
        return None if text is None else text.encode()


def plugin(library, inside, around="{}"):
    return around.format(f'<gazebo><plugin name="p" filename="lib{library}.so">{inside}</plugin></gazebo>')


def gazebo(description, remaps="", before="", spawn=SPAWN):
    launch = f'{before}<node pkg="gazebo_ros" type="gzserver" name="gazebo">{remaps}</node>{DESCRIBE}{spawn}'
    return next(
        one for one in evaluate_ros1("a.launch", Written(launch, description)).nodes if "gazebo" in str(one.name)
    )


def names(node):
    return [str(one.name) for one in node.plugged]


def test_every_line_of_the_catalogue_tells_an_endpoint_and_its_source():
    for one in plugins().values():
        assert ": " in one.source
        for key, role in ROLES.items():
            for line in getattr(one, key, ()):
                endpoint_of(f"x {line.partition(' ')[2]}", role, "ros1", Evidence("a", 1))


def test_what_a_plugin_is_given_names_its_topics():
    imu = plugin("hector_gazebo_ros_imu", "<robotNamespace>$(arg ns)</robotNamespace><topicName>imu/data</topicName>")
    found = gazebo(imu)
    assert names(found)[:2] == ["/imu/data", "/imu/data/bias"]
    assert {"/imu/data/calibrate", "/imu/data/set_accel_bias", "/imu/data/yaw/set_parameters"} < set(names(found))
    assert (found.plugged[0].evidence.path, found.plugged[0].evidence.line) == ("robot/r.xacro", 1)


def test_defaults_and_global_names():
    assert names(gazebo(plugin("gazebo_ros_laser", "<topicName>/front/scan</topicName>"))) == ["/front/scan"]
    assert names(gazebo(plugin("hector_gazebo_ros_imu", ""))) == []
    assert names(gazebo(plugin("gazebo_ros_planar_move", "<robotNamespace>r</robotNamespace>"))) == [
        "/r/odom",
        "/tf",
        "/r/cmd_vel",
    ]


@pytest.mark.parametrize(
    ("remap", "expected"),
    [
        ("", "/camera/left/image_raw"),
        ('<remap from="camera/left" to="left_camera"/>', "/left_camera/image_raw"),
    ],
)
def test_the_namespace_of_a_camera_is_remapped(remap, expected):
    inside = "<cameraName>camera</cameraName>"
    around = '<gazebo><sensor type="multicamera"><camera name="left"/>{}</sensor></gazebo>'
    camera = around.format('<plugin filename="libgazebo_ros_multicamera.so">' + inside + "</plugin>")
    found = gazebo(camera, remap)
    assert names(found)[0] == expected
    assert len(found.taken) == bool(remap)


def test_a_remapping_that_stands_behind_the_node_does_not_hold_for_it():
    camera = plugin("gazebo_ros_camera", "<cameraName>cam</cameraName>")
    behind = '<remap from="cam" to="other"/>' + SPAWN
    assert names(gazebo(camera, spawn=behind))[0] == "/cam/image_raw"
    assert names(gazebo(camera, before='<remap from="cam" to="other"/>'))[0] == "/other/image_raw"


def test_the_namespace_of_plugins_is_that_of_who_spawns_them():
    laser = plugin("gazebo_ros_laser", "<topicName>scan</topicName>")
    assert names(gazebo(laser, spawn=SPAWN.replace("-model m", "-robot_namespace r1"))) == ["/r1/scan"]
    assert names(gazebo(laser, spawn="")) == []


def test_conditions_of_the_spawner_and_of_the_description_hold():
    laser = plugin("gazebo_ros_laser", "<topicName>scan</topicName>", '<xacro:if value="$(env A)">{}</xacro:if>')
    found = gazebo(laser, spawn=f'<group if="$(env B)">{SPAWN}</group>')
    assert as_written(found.plugged[0].conditions) == ("$(env B)", "$(env A)")


def test_what_is_missing_of_a_description_is_told():
    launch = evaluate_ros1(
        "a.launch", Written(f'<node pkg="gazebo_ros" type="gzserver" name="g"/>{DESCRIBE}{SPAWN}', "<xacro:arm/>")
    )
    assert [(one.text, one.evidence.path) for one in launch.unresolved] == [("xacro:arm", "robot/r.xacro")]


def test_the_command_may_come_from_an_argument():
    laser = plugin("gazebo_ros_laser", "<topicName>scan</topicName>")
    describe = (
        '<arg name="c" value="xacro.py \'$(find robot)/r.xacro\'"/><param name="robot_description" command="$(arg c)"/>'
    )
    launch = f'{describe}{SPAWN}<node pkg="gazebo_ros" type="gzserver" name="gazebo"/>'
    assert names(evaluate_ros1("a.launch", Written(launch, laser)).nodes[-1]) == ["/scan"]
