from roslens.compare.conformance.configured import source_side
from roslens.compare.conformance.disparity import ABSENT, Reason
from roslens.compare.conformance.join import conformance
from roslens.compare.conformance.observed import running_side
from roslens.compare.conformance.side import Side, SideKind
from roslens.judge.reading.read_reference import GivenText, load_reference
from roslens.live.window.signals import BY_KEY
from roslens.model.configuration import Configuration, ConfiguredNode, Proof
from roslens.model.finding import Severity
from roslens.model.graph import Endpoint, Graph, Node, Role

GRAPH = Graph(
    "ros2",
    (Node("/lidar"), Node("/planner"), Node("/spy")),
    (Endpoint("/lidar", Role.PUBLISHER, "/scan", "sensor_msgs/msg/LaserScan"),),
    parameters={"/lidar": {"rate": "20"}, "/planner": {}, "/spy": {}},
)


def reference(text):
    read = load_reference(
        [GivenText("rover.yaml", f"kind: reference\nname: rover\nconstraints:\n{text}".encode())], BY_KEY
    )
    return Side(SideKind.REFERENCE, "rover.yaml", reference=read)


def compared(text, *more):
    return conformance((reference(text), running_side(GRAPH, "live"), *more))


def test_what_must_be_there_and_is_not_is_told_with_its_place():
    [one] = compared("  - node: /{lidar,camera}\n    expected: always\n    severity: error\n").disparities
    assert (one.subject, one.values, one.reason) == ("node /camera", ("is always there", ABSENT), Reason.MISSING)
    assert (one.severity, one.place.partition(":")[0], one.right) == (Severity.ERROR, "rover.yaml", "the reference")


def test_what_must_never_be_there_is_told():
    [one] = compared("  - node: /spy\n    expected: never\n").disparities
    assert (one.subject, one.reason, one.values[1]) == ("node /spy", Reason.NOT_EXPECTED, "there")


def test_a_sentence_about_nothing_says_what_may_be_meant():
    [one] = compared("  - topic: /scna\n    rate: 20..30 Hz\n").disparities
    assert (one.reason, one.severity) == (Reason.MISSING, Severity.WARNING)
    assert "/scan" in one.why


def test_a_value_of_a_parameter_that_is_not_allowed_is_told():
    [one] = compared("  - parameter: /lidar/rate\n    value: 25\n").disparities
    assert (one.subject, one.values[1]) == ("parameter /lidar/rate", "20")


def test_what_no_sentence_is_about_is_counted():
    told = compared("  - topic: /scan\n    rate: 20..30 Hz\n").notes
    assert any("3 of 3 nodes" in text for text in told)


def test_source_that_lacks_what_is_expected_is_told_beside_what_runs():
    source = source_side(Configuration("l", "ros2"))
    rows = conformance((source, running_side(GRAPH, "live"), reference("  - node: /lidar\n    expected: always\n")))
    [row] = [one for one in rows.disparities if one.node == "/lidar" and not one.name]
    assert row.values == (ABSENT, "there", "is always there")


def test_what_neither_side_has_is_one_row():
    source = source_side(Configuration("l", "ros2"))
    rows = conformance((source, running_side(GRAPH, "live"), reference("  - node: /arm\n    expected: always\n")))
    [row] = [one for one in rows.disparities if one.reason is Reason.MISSING]
    assert row.values == (ABSENT, ABSENT, "is always there")


def test_what_runs_not_though_source_and_reference_have_it_is_one_row():
    node = ConfiguredNode("/arm", Proof("arm.launch.xml", 3), package="arm", executable="arm")
    source = source_side(Configuration("l", "ros2", (node,)))
    expected = reference("  - node: /arm\n    expected: always\n    text: Start it\n")
    rows = conformance((source, running_side(GRAPH, "live"), expected)).disparities
    [row] = [one for one in rows if one.node == "/arm"]
    assert row.values == ("arm/arm", ABSENT, "is always there")
    assert (row.reason, row.severity) == (Reason.NOT_RUNNING, Severity.ERROR)
    assert row.why.endswith("Start it")
