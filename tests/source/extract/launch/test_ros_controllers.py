import msgspec
import pytest

from roslens.model.graph import Role
from roslens.source.extract.facts.files import FolderFiles
from roslens.source.extract.facts.launched import Launch, Launched, Setting
from roslens.source.extract.facts.node_facts import EndpointFact, Evidence
from roslens.source.extract.launch.ros_controllers import controllers, with_controllers
from roslens.source.extract.symbolic.condition import as_written
from roslens.source.extract.symbolic.text import Text, Written, unknown

START, YAML = Evidence("pkg/a.launch", 3), Evidence("pkg/controllers.yaml", 4)
SERVICE = Text.of("controller_manager/load_controller")
LOADS = EndpointFact(Role.SERVICE_SERVER, SERVICE, Text.of("controller_manager_msgs/LoadController"), START)
GAZEBO = Launched(Text.of("gazebo_ros"), Text.of("gzserver"), START, Text.of("gazebo"), plugged=(LOADS,))


class NoFiles(FolderFiles):
    def __init__(self, **files):
        self.files = files

    def content(self, path):
        return self.files.get(path)


def spawner(*words, **others):
    texts = tuple(one if isinstance(one, Text) else Text.of(one) for one in words)
    return Launched(Text.of("controller_manager"), Text.of("spawner"), START, Text.of("s"), arguments=texts, **others)


def set_to(name, value):
    return Setting(Text.of(name), value if isinstance(value, Text) else Text.of(value), YAML)


def launched(*nodes, settings=(), **files):
    return with_controllers(Launch("ros1", nodes, settings), NoFiles(**files))


def made(launch):
    return [(one.role.value, one.name.pattern) for node in launch.nodes for one in node.plugged if one is not LOADS]


VELOCITY = set_to("/base/type", "velocity_controllers/JointVelocityController")


def test_a_controller_is_in_the_node_with_its_manager():
    found = launched(GAZEBO, spawner("base", conditions=(Written("on"),)), settings=(VELOCITY,))
    (one,) = [end for end in found.nodes[0].plugged if end is not LOADS]
    assert (one.role, str(one.name), one.type.known, as_written(one.conditions)) == (
        Role.SUBSCRIPTION, "/base/command", "std_msgs/Float64", ("on",),
    )  # fmt: skip
    assert (one.evidence.path, one.evidence.line, one.evidence.sure.value) == (YAML.path, 4, "likely")
    assert found.nodes[1].plugged == ()
    assert found.unresolved == ()


def test_names_of_the_manager_and_of_dynamic_reconfigure():
    settings = (
        set_to("/joints/type", "joint_state_controller/JointStateController"),
        set_to("/arm/type", "effort_controllers/JointPositionController"),
    )
    assert made(launched(GAZEBO, spawner("joints", "arm"), settings=settings)) == [
        ("publisher", "/joint_states"),
        ("publisher", "/arm/state"),
        ("subscription", "/arm/command"),
        ("publisher", "/arm/pid/parameter_descriptions"),
        ("publisher", "/arm/pid/parameter_updates"),
        ("service_server", "/arm/pid/set_parameters"),
    ]


@pytest.mark.parametrize(
    ("value", "told"), [(None, None), ("false", None), ("true", ()), (unknown("argument x"), ("publish_cmd (false)",))]
)
def test_parameters_of_a_controller_decide(value, told):
    settings = [set_to("/base/type", "diff_drive_controller/DiffDriveController")]
    settings += [] if value is None else [set_to("/base/publish_cmd", value)]
    found = launched(GAZEBO, spawner("base"), settings=tuple(settings))
    ends = {one.name.pattern: as_written(one.conditions) for one in found.nodes[0].plugged}
    assert ends.get("/base/cmd_vel_out") == told
    assert "/tf" in ends


def test_a_spawner_may_be_given_files_and_a_namespace():
    gazebo = msgspec.structs.replace(GAZEBO, namespace=Text.of("/robot"))
    file = b"base: {type: velocity_controllers/JointVelocityController}\n"
    found = launched(gazebo, spawner("c.yaml", namespace=Text.of("/robot")), **{"c.yaml": file})
    assert made(found) == [("subscription", "/robot/base/command")]
    assert [one.name.pattern for one in found.settings] == ["/robot/base/type"]
    settings = (set_to("/robot/base/type", "velocity_controllers/JointVelocityController"),)
    for words in (("--namespace", "robot", "base"), ("--namespace=/robot", "--timeout", "5", "--stopped", "base")):
        assert made(launched(gazebo, spawner(*words), settings=settings)) == [("subscription", "/robot/base/command")]


UNKNOWN = "its endpoints are unknown"


@pytest.mark.parametrize(
    ("nodes", "settings", "why"),
    [
        ((GAZEBO, spawner("base")), (), f"no parameter file states its type; {UNKNOWN}"),
        ((GAZEBO, spawner("base")), (set_to("/base/type", "own/C"),), f"own/C is not a known controller; {UNKNOWN}"),
        ((spawner("base"),), (VELOCITY,), "the node with the manager of this controller is unknown"),
    ],
)  # fmt: skip
def test_what_is_unknown_is_said(nodes, settings, why):
    found = launched(*nodes, settings=settings)
    assert made(found) == []
    later = [(f"controller {one.name.pattern[1:]}", one.why) for node in found.nodes for one in node.controllers]
    assert [*((one.text, one.reason) for one in found.unresolved), *later] == [("controller base", why)]


def test_a_broken_file_of_a_spawner_makes_nothing():
    for words, text in ((("c.yaml",), "controller c.yaml"), (("gone.yaml",), "controller gone.yaml")):
        found = launched(GAZEBO, spawner(*words), **{"c.yaml": b"a: [\n"})
        assert made(found) == []
        assert [one.text for one in found.unresolved] == [text]


def test_a_name_that_is_unknown_is_said():
    found = launched(GAZEBO, spawner(unknown("argument which")))
    assert [one.reason for one in found.unresolved] == ["its name depends on argument which"]


def test_each_type_of_the_catalogue_makes_something():
    for kind in controllers():
        assert made(launched(GAZEBO, spawner("c"), settings=(set_to("/c/type", kind),))), kind
