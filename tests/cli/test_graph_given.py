import pytest

from roslens.cli.graph.graph_given import wrong_arguments
from roslens.model.configuration import Configuration, ConfiguredArgument, ConfiguredNode, Origin, Proof

PLACE = Proof("talk/launch/talk.launch.xml", 2)
TALK = Configuration(
    "talk",
    "ros2",
    nodes=(ConfiguredNode("/talker", Proof("talk/launch/talk.launch.xml", 4, origin=Origin.LAUNCH)),),
    arguments=(
        ConfiguredArgument("port", PLACE, "/dev/ttyACM0"),
        ConfiguredArgument("robot", PLACE),
        ConfiguredArgument("speed", PLACE, "slow", choices=("slow", "fast")),
    ),
)


@pytest.mark.parametrize(
    ("given", "words"),
    [
        ({"robot": "a", "port": "b", "speed": "fast"}, []),
        ({"robot": "a", "prot": "b"}, ["argument `prot` is given", "Did you mean `port`?"]),
        ({"robot": "a", "camera": "b"}, ["argument `camera` is given", "It declares port, robot, speed."]),
        ({}, ["argument `robot` must be given", "Give `robot:=…`"]),
        ({"robot": "a", "speed": "odd"}, ["argument `speed` is given as `odd`", "allows slow, fast"]),
    ],
)
def test_what_is_given_and_not_taken_is_told(given, words):
    lines = list(wrong_arguments(TALK, given))
    assert len(lines) == (1 if words else 0)
    assert all(word in line for line in lines for word in words)
    assert all(line.startswith("talk/launch/talk.launch.xml:2: ") for line in lines)
