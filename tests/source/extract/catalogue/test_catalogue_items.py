import pytest

from roslens.model.graph import Role
from roslens.source.extract.catalogue.catalogue_items import each_item
from roslens.source.extract.catalogue.hints import endpoint_of
from roslens.source.extract.facts.launched import Setting
from roslens.source.extract.facts.node_facts import Evidence
from roslens.source.extract.facts.resolve_name import Place
from roslens.source.extract.parameters.assemble_parameters import Values
from roslens.source.extract.symbolic.text import Text, unknown

HERE = Evidence("pkg/a.yaml", 3)


def names(line, generation, *settings):
    values = Values(
        Place(Text.of("/"), Text.of("/mux"), generation),
        [
            Setting(Text.of(name), value if isinstance(value, Text) else Text.of(value), HERE)
            for name, value in settings
        ],
    )
    fact = endpoint_of(line, Role.SUBSCRIPTION, generation, HERE)
    return [str(one.name) for one in each_item(fact, values)]


EACH = "{~topics[].topic} geometry_msgs/Twist 1"


@pytest.mark.parametrize(
    ("value", "told"),
    [
        ("[{name: joy, topic: joy/cmd_vel, timeout: 0.5}, {topic: /navi, name: n}]", ["joy/cmd_vel", "/navi"]),
        ("[{name: joy}, 3, {topic: [1]}]", []),
        ("[]", []),
        ("{a: 1}", ["{topic of each item of ~topics, which is not a list}"]),
        ("[{a: ", ["{topic of each item of ~topics, which is not a list}"]),
        (unknown("argument x"), ["{topic of each item of ~topics}"]),
    ],
)
def test_maps_in_a_list(value, told):
    assert names(EACH, "ros1", ("~topics", value)) == told


def test_a_list_that_nobody_sets_has_no_items():
    assert names(EACH, "ros1") == []


def test_parameters_side_by_side():
    settings = (("topics.joy.topic", "a"), ("topics.navi.topic", "/b"), ("topics.navi.timeout", "1"))
    line = "{topics.*.topic} geometry_msgs/msg/Twist"
    assert names(line, "ros2", *settings, ("topics.a.b.topic", "c")) == ["a", "/b"]
    assert names(line, "ros2") == []


def test_other_names_are_kept():
    assert names("{~scan=scan} sensor_msgs/LaserScan", "ros1") == ["{parameter ~scan}"]
    assert names("scan sensor_msgs/LaserScan", "ros1") == ["scan"]
