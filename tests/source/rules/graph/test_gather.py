from roslens.model.source import Location, Package
from roslens.source.extract.facts.launched import Launch, Unresolved
from roslens.source.extract.facts.node_facts import Evidence, Target, TargetKind
from roslens.source.rules.graph.gather import surroundings_of
from roslens.source.rules.graph.surroundings import Surroundings
from testbed.configured import configuration, node

PLACE = Evidence("robot/CMakeLists.txt", 3)
PACKAGES = tuple(Package(name, name, name, Location(f"{name}/package.xml", 1)) for name in ("robot", "other"))
TARGETS = {
    "robot": (
        Target(TargetKind.EXECUTABLE, "robot", "slam", (), PLACE),
        Target(TargetKind.EXECUTABLE, "robot", "tool", (), PLACE, installed=False),
        Target(TargetKind.NODELET, "robot", "robot/Filter", (), PLACE, entry="robot::Filter"),
    ),
    "other": (),
}


def gathered(generation="ros2", **more):
    known = configuration(node("/a"), generation=generation)
    return surroundings_of(known, packages=PACKAGES, targets=TARGETS, **more)


def test_names_by_which_something_is_started_or_loaded():
    assert gathered().installed == {"other": (), "robot": ("Filter", "robot/Filter", "robot::Filter", "slam")}


def test_ros1_starts_what_lies_in_the_sources():
    found = gathered("ros1", paths={"other": ("other/scripts/run.py",)})
    assert found.installed["other"] == ("run.py",)
    assert "tool" in found.installed["robot"]


def test_sources_that_no_target_is_made_of():
    targets = {"robot": (Target(TargetKind.EXECUTABLE, "robot", "slam", ("robot/src/slam.cpp",), PLACE),)}
    paths = {"robot": ("robot/src/slam.cpp", "robot/src/joy.cpp", "robot/src/joy.hpp", "robot/run.py")}
    known = surroundings_of(configuration(node("/a")), packages=PACKAGES, targets=targets, paths=paths)
    assert known.unbuilt == {"robot": ("robot/src/joy.cpp",)}


def test_a_build_that_is_not_understood_says_nothing():
    missed = (Unresolved("x", Evidence("robot/CMakeLists.txt", 9), "a macro"),)
    assert set(gathered(unresolved=missed).installed) == {"other"}


def test_what_is_given_is_kept_and_what_is_not_is_empty():
    assert surroundings_of(configuration()) == Surroundings()
    found = gathered(given={"sim": "true"}, launch=Launch("ros2"), options={"fast_hz": 5.0})
    assert (found.given, found.fast_hz, found.packages) == ({"sim": "true"}, 5.0, PACKAGES)
