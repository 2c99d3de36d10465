import msgspec
import pytest

from roslens.model.configuration import ConfiguredParameter, ConfiguredRemap
from roslens.model.finding import Severity
from roslens.source.rules.graph.parameters.stamped_command import controllers, found
from roslens.source.rules.graph.surroundings import Surroundings
from testbed.configured import configuration, end, launched, node

TYPE = "diff_drive_controller/DiffDriveController"
FILE = f"""
controller_manager:
  ros__parameters:
    drive:
      type: {TYPE}
    arm:
      type: joint_trajectory_controller/JointTrajectoryController
"""


def teleop(topic="/drive/cmd_vel", type_="geometry_msgs/msg/Twist", package="teleop_twist_keyboard", **more):
    return node("/teleop", end("pub", topic, type_), package=package, **more)


def findings(*nodes, text=FILE):
    whole = configuration(*nodes)
    known = controllers(whole, ["README.md", "a/config.yaml"], {"a/config.yaml": text.encode()}.get)
    return list(found(whole, Surroundings(controllers=tuple(known))))


def test_commands_without_a_stamp_on_the_topic_of_a_controller_are_told():
    (one,) = findings(teleop())
    assert one.severity is Severity.WARNING
    assert one.message == (
        "/teleop publishes /drive/cmd_vel as geometry_msgs/msg/Twist, and controller 'drive' "
        f"({TYPE}, a/config.yaml:5) takes geometry_msgs/msg/TwistStamped there: they are never connected. Expected "
        "stamped commands: set its parameter `stamped` to true."
    )
    (other,) = findings(teleop(package="rover"))
    assert "publish TwistStamped" in other.message


@pytest.mark.parametrize(
    "fine",
    [
        teleop(type_="geometry_msgs/msg/TwistStamped"),
        teleop("/cmd_vel"),
        teleop("/arm/cmd_vel"),
        teleop("/drive/cmd_vel_unstamped"),
        teleop(package="nav2_controller"),
    ],
)
def test_what_a_controller_receives_or_has_nothing_to_do_with_is_none(fine):
    assert not findings(fine)


def test_a_remapping_of_the_manager_moves_the_topic():
    remap = ConfiguredRemap("/drive/cmd_vel", "/cmd_vel", launched(4))
    manager = node("/controller_manager", package="controller_manager", remaps=(remap,))
    (one,) = findings(teleop("/cmd_vel"), manager)
    assert "/cmd_vel" in one.message
    assert not findings(teleop("/cmd_vel"), msgspec.structs.replace(manager, package="other"))


@pytest.mark.parametrize(
    ("package", "name"), [("nav2_controller", "enable_stamped_cmd_vel"), ("twist_mux", "use_stamped")]
)
def test_of_what_later_releases_stamp_only_what_is_set_is_told(package, name):
    said = ConfiguredParameter(name, "false", "bool", set_type="bool", set_by=launched(7))
    (one,) = findings(teleop(package=package, parameters=(said,)))
    assert f"`{name}`" in one.message
    assert not findings(teleop(package=package))


@pytest.mark.parametrize("text", ["", "a: [", FILE.replace(TYPE, "own/Drive"), "ros__parameters: " + TYPE])
def test_a_file_without_such_a_controller_says_nothing(text):
    assert not findings(teleop(), text=text)
