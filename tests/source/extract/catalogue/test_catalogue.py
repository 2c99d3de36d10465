import pytest

from roslens.model.configuration import Origin
from roslens.model.errors import DocumentError
from roslens.model.graph import Role
from roslens.source.extract.catalogue.catalogue import entries, facts_of, known_node, read_catalogue
from roslens.source.extract.facts.launched import Launched
from roslens.source.extract.facts.node_facts import Evidence, Sure
from roslens.source.extract.symbolic.text import Text

HERE = Evidence("a.launch.py", 1)


def launched(package: str, executable: str = "", plugin: str = "") -> Launched:
    return Launched(Text.of(package), Text.of(executable), HERE, plugin=Text.of(plugin))


def test_every_entry_reads_and_names_its_source():
    assert len(entries()) > 40
    for entry in entries():
        facts = facts_of(entry)
        assert ": " in entry.source
        for one in facts.endpoints:
            parts = 1 if entry.generation == "ros1" else 2
            assert one.type.holes or one.type.pattern.count("/") == parts, (entry.package, one.name)
            assert one.evidence.sure is Sure.LIKELY


def test_no_two_entries_are_for_the_same_program():
    names = [(entry.generation, entry.package, name) for entry in entries() for name in entry.executables]
    assert len(set(names)) == len(names)


def test_a_node_is_known_by_package_and_executable_or_class():
    by_name = known_node(launched("robot_state_publisher", "robot_state_publisher"), "ros2", ())
    by_class = known_node(launched("x", plugin="robot_state_publisher::RobotStatePublisher"), "ros2", ())
    assert by_name is not None
    assert by_name == by_class
    assert by_name.origin is Origin.CATALOGUE
    assert known_node(launched("robot_state_publisher", "other"), "ros2", ()) is None


def test_a_name_with_a_random_end_is_that_of_the_program_and_not_of_its_component():
    alone = known_node(launched("tf2_ros", "static_transform_publisher"), "ros2", ())
    loaded = known_node(launched("x", plugin="tf2_ros::StaticTransformBroadcasterNode"), "ros2", ())
    assert alone is not None
    assert loaded is not None
    assert [str(hole.reason) for hole in alone.facts[0].name.holes] == ["random end"]
    assert loaded.facts[0].name.known == "static_transform_publisher"
    assert alone.facts[0].endpoints[0].name == loaded.facts[0].endpoints[0].name


def test_the_command_line_names_what_a_bridge_of_images_publishes():
    meant = known_node(launched("ros_gz_image", "image_bridge"), "ros2", (Text.of("camera"),))
    assert meant is not None
    assert [(one.role, one.name.known) for one in meant.facts[0].endpoints] == [(Role.PUBLISHER, "camera")]


@pytest.mark.parametrize(
    ("document", "line", "what"),
    [
        ("nodes:\n- package: a\n  generation: ros1\n  source: s\n  publish: [x]\n", 2, "publish"),
        ("nodes:\n- package: a\n  generation: ros1\n", 2, "source"),
        ("nodes:\n- package: a\n  generation: ros1\n  source: s\n  publishes: [scan]\n", 2, "scan"),
        ("nodes:\n- package: a\n  generation: ros1\n  source: s\n  publishes: x\n", 5, "array"),
    ],
)
def test_what_is_not_valid_is_told_with_its_place(document, line, what):
    with pytest.raises(DocumentError, match=what) as error:
        read_catalogue(document.encode(), "nodes.yaml")
    assert f"nodes.yaml:{line}" in str(error.value)
