import msgspec
import pytest

from roslens.model.configuration import Clause
from roslens.source.extract.facts.launched import Launch, Launched
from roslens.source.extract.facts.node_facts import Evidence
from roslens.source.extract.symbolic.text import Text, Written, unknown
from roslens.source.rules.graph.static_transforms import frames_of, static_transforms
from roslens.source.rules.graph.surroundings import Transform
from testbed.configured import configuration, launched, node

PLACE = Evidence("launch/robot.launch.xml", 4)


@pytest.mark.parametrize(
    ("line", "frames"),
    [
        ("0 0 0.5 0 0 0 base laser 100", ("base", "laser")),
        ("0 0 0.5 0 0 0 1 /base laser", ("/base", "laser")),
        ("--x 1 --frame-id base --child-frame-id laser", ("base", "laser")),
        ("0 0 0 base laser", None),
        ("0 0 0 0 0 0", None),
        ("--frame-id base", None),
        ("", None),
    ],
)
def test_frames_of_command_lines(line, frames):
    assert frames_of(line.split()) == frames


def publisher(*words, executable="static_transform_publisher"):
    arguments = tuple(Text.of(word) if isinstance(word, str) else word for word in words)
    return Launched(Text.of("tf2_ros"), Text.of(executable), PLACE, arguments=arguments, conditions=(Written("sim"),))


def test_a_publisher_is_named_as_in_the_configuration():
    words = ["0", "0", "0", "0", "0", "0", "base", "laser"]
    known = configuration(node("/ns/tf_laser", line=4))
    found = list(static_transforms(known, Launch("ros2", (publisher(*words),))))
    assert found == [Transform("/ns/tf_laser", "base", "laser", launched(4), ("sim",), (Clause("sim"),))]
    assert not list(static_transforms(known, Launch("ros2", (publisher(*words, executable="other"),))))
    assert not list(static_transforms(known, Launch("ros2", (publisher(*words[:-1], unknown("argument frame")),))))


def test_of_several_nodes_of_one_line_each_has_its_own_transform():
    words = ["0", "0", "0", "0", "0", "0"]
    known = configuration(node("/boat1/tf", line=4), node("/boat2/tf", line=4))
    started = [
        msgspec.structs.replace(publisher(*words, f"{boat}/base", "laser"), name=Text.of("tf"), namespace=Text.of(boat))
        for boat in ("/boat1", "/boat2")
    ]
    found = list(static_transforms(known, Launch("ros2", tuple(started))))
    assert [(one.node, one.parent) for one in found] == [("/boat1/tf", "/boat1/base"), ("/boat2/tf", "/boat2/base")]
