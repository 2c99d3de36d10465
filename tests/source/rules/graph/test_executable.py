import msgspec

from roslens.model.configuration import NAME_IS_GUESSED, Proof
from roslens.model.finding import Severity
from roslens.model.source import Dependency, Location, Package
from roslens.source.rules.graph.executable import found
from roslens.source.rules.graph.surroundings import Surroundings
from testbed.configured import configuration, launched, node

INSTALLED = {"robot": ("slam_node", "robot::Slam", "Filter")}


def findings(*nodes):
    return list(found(configuration(*nodes), Surroundings(installed=INSTALLED)))


def test_a_name_that_no_build_makes_is_told_with_what_was_meant():
    (one,) = findings(node("/slam", executable="slam_nod", line=4, known=False))
    assert one.message == (
        "no executable `slam_nod` in package robot, which launch/robot.launch.xml:4 starts as /slam; "
        "did you mean `slam_node`?"
    )


def test_that_a_node_has_no_name_leaves_no_doubt_about_what_is_started():
    guessed = launched(4, sure="likely")
    (sure,) = findings(
        node("/x", executable="x", known=False, proof=msgspec.structs.replace(guessed, how=NAME_IS_GUESSED))
    )
    (likely,) = findings(node("/x", executable="x", known=False, proof=guessed))
    assert (sure.severity, likely.severity) == (Severity.ERROR, Severity.WARNING)
    assert "In doubt" not in sure.message


def test_what_is_installed_and_what_is_not_known_is_none():
    assert not findings(
        node("/a", executable="slam_node"),
        node("/b", executable="robot::Slam", kind="component"),
        node("/c", executable="robot/Filter", package="nodelet", kind="nodelet"),
        node("/d", executable="x", package="elsewhere"),
        node("/e", executable="slam_*"),
        node("/f", executable="echo", kind="process"),
        node("/g", executable="/opt/venv/bin/python"),
    )


def test_a_nodelet_is_looked_for_in_its_package():
    (one,) = findings(node("/c", executable="robot/Filtre", package="nodelet", kind="nodelet"))
    assert one.message.startswith("no nodelet `Filtre` in package robot")
    assert one.message.endswith("; did you mean `Filter`?")


def test_a_program_of_another_package_and_all_there_are():
    installed = {
        "robot": ("slam_node", "robot.slam:main", "CMakeLists.txt", "README.md", "talker.py"), "demo": ("talk",),
    }  # fmt: skip
    unlike, elsewhere = found(
        configuration(node("/a", executable="talk", line=3), node("/b", executable="map_server", line=4)),
        Surroundings(installed=installed),
    )
    assert elsewhere.message.endswith("; package demo has one of that name.")
    assert unlike.message.endswith(". It installs slam_node, talker.py: correct the name, or install it.")


def test_a_source_of_that_name_that_no_target_is_made_of_is_told_before_a_name_like_it():
    unbuilt = {"robot": ("robot/src/key.cpp", "robot/src/teleop_joy.cpp")}
    known = Surroundings(installed={"robot": ("teleop_key",)}, unbuilt=unbuilt)
    (one,) = found(configuration(node("/joy", executable="teleop_joy")), known)
    assert one.message.endswith("starts as /joy; robot/src/teleop_joy.cpp is not built: add it to CMakeLists.txt.")


def test_targets_that_stand_for_themselves_are_none():
    assert not findings(node("/a", executable="x", proof=Proof("CMakeLists.txt", 3)))


def test_a_package_that_is_not_there_and_nearly_one_that_has_the_program():
    started = node("/slam", package="robto", executable="slam_node", line=4, known=False)
    (one,) = findings(started)
    assert one.message == (
        "no package `robto` is known, of which launch/robot.launch.xml:4 starts executable `slam_node`; did you mean "
        "`robot`, which installs it? Else add <exec_depend>robto</exec_depend>. In doubt: `robto` may be installed on "
        "the target machine."
    )
    assert one.severity is Severity.WARNING
    guessed = launched(4, sure="likely")
    (same,) = findings(node("/slam", package="robto", executable="slam_node", known=False, proof=guessed))
    assert same.severity is Severity.WARNING
    assert not findings(node("/slam", package="robto", executable="other_node", known=False))
    place = Location("package.xml", 1)
    for one in (
        Package("bringup", "bringup", ".", place, dependencies=(Dependency("robto", "exec", place),)),
        Package("robto", "robto", "robto", place),
    ):
        assert not list(found(configuration(started), Surroundings(installed=INSTALLED, packages=(one,))))
