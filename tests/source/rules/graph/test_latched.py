import pytest

from roslens.model.configuration import ConfiguredTimer, Origin, Proof, Unresolved
from roslens.model.finding import Severity
from roslens.model.qos import Qos
from roslens.source.rules.graph.surroundings import Surroundings
from roslens.source.rules.graph.timing.latched import found
from testbed.configured import LATCHED, RELIABLE, configuration, end, launched, node

FACTOR = "std_msgs/msg/Float64"
LATE = node("/load", end("sub", "/factor", FACTOR, line=10, qos=RELIABLE))


def findings(*nodes, **more):
    return list(found(configuration(*nodes, **more), Surroundings()))


def scale(**more):
    return node("/scale", end("pub", "/factor", FACTOR, line=12, qos=LATCHED), **more)


def test_a_volatile_subscription_of_what_is_published_once_is_told_at_its_place():
    (one,) = findings(scale(), LATE)
    assert one.severity is Severity.WARNING
    assert (one.path, one.line, one.entity) == ("src/load.cpp", 10, "topic:/factor")
    assert one.message == (
        "/load (src/load.cpp:10) requests volatile on /factor, /scale (src/scale.cpp:12) offers transient_local and "
        "publishes seldom: what was published before the subscription was there does not arrive. Request "
        "transient_local at the subscription."
    )


@pytest.mark.parametrize(
    "publisher",
    [
        scale(timers=(ConfiguredTimer(1.0, Proof("src/scale.cpp", 3)),)),
        node("/scale", end("pub", "/factor", FACTOR, qos=LATCHED), end("sub", "/scan")),
        node("/scale", end("pub", "/factor", FACTOR, qos=RELIABLE)),
        node("/scale", end("pub", "/factor", FACTOR, qos=Qos())),
        node("/scale", end("pub", "/factor", FACTOR, qos=LATCHED, qos_unknown="{parameter durability}")),
        node("/scale", end("pub", "/factor", FACTOR, qos=LATCHED, origin=Origin.CATALOGUE)),
    ],
    ids=["timer", "on another message", "volatile", "unknown", "partly unknown", "elsewhere"],
)
def test_what_comes_again_or_is_not_known_to_be_kept_is_none(publisher):
    assert not findings(publisher, LATE)


def test_a_subscription_that_takes_it_or_is_unknown_is_none():
    assert not findings(scale(), node("/load", end("sub", "/factor", FACTOR, qos=LATCHED)))
    assert not findings(scale(), node("/load", end("sub", "/factor", FACTOR)))
    assert not findings(scale(), node("/rviz", end("sub", "/factor", FACTOR, qos=RELIABLE, origin=Origin.CATALOGUE)))


def test_a_second_publisher_that_repeats_it_is_enough():
    again = node("/again", end("pub", "/factor", FACTOR, qos=RELIABLE))
    assert not findings(scale(), again, LATE)


def test_a_map_server_is_known_to_publish_seldom():
    served = end("pub", "/map", "nav_msgs/msg/OccupancyGrid", qos=LATCHED, origin=Origin.CATALOGUE)
    reader = node("/reader", end("sub", "/map", "nav_msgs/msg/OccupancyGrid", qos=RELIABLE))
    assert len(findings(node("/map_server", served, executable="map_server"), reader)) == 1


def test_what_excludes_each_other_what_is_not_understood_and_ros_1_are_none():
    assert not findings(
        scale(conditions=("sim",)), node("/load", end("sub", "/factor", FACTOR, qos=RELIABLE), conditions=("not sim",))
    )
    unknown = Unresolved("make()", launched(2), "it is not followed", node="/scale")
    assert not findings(scale(), LATE, unresolved=(unknown,))
    assert not findings(scale(), LATE, generation="ros1")
