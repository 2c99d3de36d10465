"""Reactions about what is not there, where it is known what is."""

import pytest

from roslens.judge.reading.read_reference import GivenText, load_reference
from roslens.judge.reference.unmatched import Subject
from roslens.judge.reference.unmatched_reactions import refuse_unknown_targets, unmatched_statements
from roslens.live.window.signals import BY_KEY
from roslens.model.entity import EntityKind
from roslens.model.errors import DocumentError

THERE = (
    Subject(EntityKind.NODE, "/lidar", "robot"),
    Subject(EntityKind.NODE, "/base", "base"),
    Subject(EntityKind.TOPIC, "/scan", "", "sensor_msgs/msg/LaserScan", "/lidar"),
)


def reactions(when: str, do: str):
    text = f"kind: reference\nname: r\nreactions:\n- id: a\n  when: {when}\n  do: [{do}]\n"
    return load_reference([GivenText("r.yaml", text.encode())], BY_KEY).reactions


@pytest.mark.parametrize(
    ("when", "said"),
    [
        ("{node: /lidar, is: gone}", []),
        ("{node: '/l*', on: robot, is: gone}", []),
        ("{topic: '**', type: sensor_msgs/msg/LaserScan, is: bad}", []),
        (
            "{node: /lider, is: gone}",
            ["r.yaml:5:10: r.a matches nothing: no node /lider exists. Did you mean '/lidar'?"],
        ),
        ("{node: '/l*', on: base, is: gone}", ["r.yaml:5:10: r.a matches nothing: no node /l* on base exists"]),
        ("{service: /x, is: there}", []),
    ],
)
def test_conditions_about_nothing(when, said):
    found = list(unmatched_statements(reactions(when, "{snapshot: {}}"), THERE, (EntityKind.NODE, EntityKind.TOPIC)))
    assert found == said


@pytest.mark.parametrize("do", ["{restart: /lidar}", "{start: /gone}", "{restart: '{entity}'}", "{notify: a}"])
def test_targets_that_are_there_or_are_not_to_be(do):
    refuse_unknown_targets(reactions("{node: /lidar, is: gone}", do), THERE)


def test_an_action_on_what_is_not_there():
    with pytest.raises(DocumentError) as error:
        refuse_unknown_targets(reactions("{node: /lidar, is: gone}", "{restart: /lidr}"), THERE)
    assert str(error.value) == (
        "r.yaml:6:9: `restart` of '/lidr'; expected a node that is there. Did you mean '/lidar'?"
    )
