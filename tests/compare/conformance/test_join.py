import time

import msgspec
import pytest
from hypothesis import given
from hypothesis import strategies as st
from pace import turned_s

from roslens.compare.conformance.configured import claims_of, source_side
from roslens.compare.conformance.disparity import ABSENT, Aspect, Reason
from roslens.compare.conformance.join import conformance
from roslens.compare.conformance.observed import recorded_side, running_side
from roslens.compare.conformance.side import Beside, Origin
from roslens.model.configuration import (
    Configuration,
    ConfiguredEndpoint,
    ConfiguredNode,
    ConfiguredParameter,
    Proof,
    Unresolved,
)
from roslens.model.errors import UsageError
from roslens.model.finding import Severity
from roslens.model.graph import Endpoint, Graph, Node, Role
from roslens.model.qos import Qos

SCAN, ODOM = "sensor_msgs/msg/LaserScan", "nav_msgs/msg/Odometry"
RELIABLE, BEST = Qos("reliable", "volatile"), Qos("best_effort", "volatile")
PUBLISHER, SUBSCRIPTION = Role.PUBLISHER, Role.SUBSCRIPTION


def end(node, role, name, kind=SCAN, qos=RELIABLE, **more):
    return ConfiguredEndpoint(Endpoint(node, role, name, kind, qos=qos), Proof("node.py", 7), **more)


def node(name, *ends, parameters=(), **more):
    defaults = {"package": "robot", "executable": name.strip("/"), "proof": Proof("robot.launch.xml", 3)}
    return ConfiguredNode(name=name, endpoints=ends, parameters=parameters, **{**defaults, **more})


LIDAR = node("/lidar", end("/lidar", PUBLISHER, "/scan", qos=BEST))
RATE = ConfiguredParameter("rate", "10", access="declared", set_by=Proof("robot.yaml", 4), default="5")
PLANNER = node(
    "/planner", end("/planner", SUBSCRIPTION, "/scan"), end("/planner", PUBLISHER, "/plan", ODOM), parameters=(RATE,)
)
ROBOT = Configuration("robot.launch.xml", "ros2", (LIDAR, PLANNER))


def running(configuration=ROBOT, **more):
    return msgspec.structs.replace(configuration.graph(), **more)


def found(*sides):
    return conformance(sides).disparities


def compared(graph, configuration=ROBOT, beside=()):
    return found(source_side(configuration, beside=beside), running_side(graph, "live"))


def told(disparities):
    return [(one.subject, one.aspect.value, one.values, one.reason) for one in disparities]


def without(graph, name):
    return msgspec.structs.replace(
        graph,
        nodes=tuple(one for one in graph.nodes if one.name != name),
        endpoints=tuple(one for one in graph.endpoints if one.node != name),
        parameters={key: of for key, of in graph.parameters.items() if key != name},
    )


def with_end(graph, *ends):
    return msgspec.structs.replace(graph, endpoints=(*graph.endpoints, *ends))


def changed(graph, name, /, **values):
    ends = tuple(msgspec.structs.replace(one, **values) if one.name == name else one for one in graph.endpoints)
    return msgspec.structs.replace(graph, endpoints=ends)


def test_what_runs_as_source_says_differs_in_nothing():
    result = conformance((source_side(ROBOT), running_side(running(), "live")))
    assert result.disparities == ()
    assert result.agreed == {"node": 2, "parameter": 1, "publisher": 2, "subscription": 1}


def test_a_node_that_does_not_run_is_one_error_with_its_parts_counted():
    [one] = compared(without(running(), "/planner"))
    assert told([one]) == [("node /planner", "presence", ("robot/planner", ABSENT), Reason.NOT_RUNNING)]
    assert (one.severity, one.also, one.right, one.place) == (Severity.ERROR, 3, "the source", "robot.launch.xml:3")


def test_a_condition_explains_what_is_not_there():
    maybe = msgspec.structs.replace(PLANNER, conditions=("navigation",))
    [one] = compared(without(running(), "/planner"), Configuration("l", "ros2", (LIDAR, maybe)))
    assert (one.reason, one.severity, one.right) == (Reason.CONDITION, Severity.NOTE, "both")
    assert "navigation" in one.why


def test_who_runs_that_source_does_not_know_is_told():
    stranger = Endpoint("/camera", PUBLISHER, "/image", "sensor_msgs/msg/Image")
    graph = with_end(running(nodes=(*running().nodes, Node("/camera"))), stranger)
    [one] = compared(graph)
    assert told([one]) == [("node /camera", "presence", (ABSENT, "there"), Reason.UNKNOWN_TO_SOURCE)]
    assert (one.severity, one.also, one.right) == (Severity.WARNING, 1, "what runs")


CAMERA = Configuration("camera.launch.xml", "ros2", (node("/camera", end("/camera", PUBLISHER, "/image")),))


@pytest.mark.parametrize(
    ("origin", "reason", "severity"),
    [
        (Origin.OTHER_LAUNCH, Reason.OTHER_LAUNCH, Severity.NOTE),
        (Origin.NOT_LAUNCHED, Reason.NOT_LAUNCHED, Severity.WARNING),
    ],
)
def test_who_else_in_the_workspace_starts_it_is_said(origin, reason, severity):
    graph = running(nodes=(*running().nodes, Node("/camera")))
    [one] = compared(graph, beside=(Beside(origin, "camera.launch.xml", claims_of(CAMERA)),))
    assert (one.reason, one.severity, one.place) == (reason, severity, "robot.launch.xml:3")


def test_what_a_library_makes_that_no_known_program_starts_is_said():
    graph = with_end(running(), Endpoint("/planner", PUBLISHER, "/costmap", ODOM))
    loose = Configuration("libraries", "ros2", (node("costmap", end("costmap", PUBLISHER, "/costmap", ODOM)),))
    [one] = compared(graph, beside=(Beside(Origin.UNSTARTED, "libraries", claims_of(loose)),))
    assert (one.reason, one.place, one.severity) == (Reason.UNSTARTED, "node.py:7", Severity.NOTE)
    assert "library" in one.why


def test_a_tool_is_no_difference_that_matters():
    graph = running(nodes=(*running().nodes, Node("/launch_ros_4711"), Node("/_ros2cli_daemon_0_ab12")))
    assert [(one.reason, one.severity) for one in compared(graph)] == [(Reason.TOOL, Severity.NOTE)] * 2


def test_another_type_is_an_error_and_what_runs_is_right():
    [one] = compared(changed(running(), "/plan", type="nav_msgs/msg/Path"))
    assert told([one]) == [("publisher /plan of /planner", "type", (ODOM, "nav_msgs/msg/Path"), Reason.CONTRADICTION)]
    assert (one.severity, one.right, one.place) == (Severity.ERROR, "what runs", "node.py:7")


def test_another_quality_of_service_is_told_by_policy():
    graph = changed(running(), "/plan", qos=Qos("best_effort", "transient_local"))
    assert told(compared(graph)) == [
        ("publisher /plan of /planner", "durability", ("volatile", "transient_local"), Reason.CONTRADICTION),
        ("publisher /plan of /planner", "reliability", ("reliable", "best_effort"), Reason.CONTRADICTION),
    ]


def test_a_quality_of_which_source_is_not_sure_is_a_note():
    unsure = end("/lidar", PUBLISHER, "/scan", qos=Qos("reliable"), qos_unknown="an argument of a function")
    source = Configuration("l", "ros2", (node("/lidar", unsure), PLANNER))
    [one] = compared(running(), source)
    assert (one.aspect, one.reason, one.severity) == (Aspect.RELIABILITY, Reason.GUESSED, Severity.NOTE)
    assert "an argument of a function" in one.why


def test_the_value_of_a_parameter_differs():
    [one] = compared(running(parameters={"/planner": {"rate": "20"}, "/lidar": {}}))
    assert told([one]) == [("parameter rate of /planner", "value", ("10", "20"), Reason.SET_OTHERWISE)]
    assert one.place == "robot.yaml:4"


def test_numbers_that_are_one_do_not_differ_and_secrets_are_not_compared():
    parameters = (
        msgspec.structs.replace(RATE, value="0.10"),
        msgspec.structs.replace(RATE, name="token", value="abc"),
    )
    source = Configuration("l", "ros2", (LIDAR, msgspec.structs.replace(PLANNER, parameters=parameters)))
    graph = running(parameters={"/planner": {"rate": "0.1", "token": "***"}, "/lidar": {}})
    assert compared(graph, source) == ()


def test_a_parameter_that_is_set_and_never_declared_is_ignored():
    wrong = ConfiguredParameter("rat", "10", set_by=Proof("robot.yaml", 5))
    source = Configuration("l", "ros2", (LIDAR, msgspec.structs.replace(PLANNER, parameters=(RATE, wrong))))
    [one] = compared(running(), source)
    assert (one.subject, one.reason, one.severity) == (
        "parameter rat of /planner", Reason.IGNORED, Severity.WARNING,
    )  # fmt: skip


def test_nodes_that_tell_no_parameters_lack_none():
    assert compared(running(parameters={"/lidar": {}})) == ()


def test_an_inactive_node_need_not_have_its_endpoints():
    graph = without(running(), "/planner")
    graph = msgspec.structs.replace(
        graph, nodes=(*graph.nodes, Node("/planner", lifecycle="unconfigured")),
        parameters={"/planner": {"rate": "10"}, "/lidar": {}},
    )  # fmt: skip
    assert {(one.reason, one.severity) for one in compared(graph)} == {(Reason.INACTIVE, Severity.NOTE)}


def test_a_renamed_node_is_one_difference_of_its_name():
    text = msgspec.json.encode(running()).replace(b"/planner", b"/planner_2")
    [one] = compared(msgspec.json.decode(text, type=Graph))
    assert told([one]) == [("node /planner", "name", ("/planner", "/planner_2"), Reason.REMAPPED)]


def test_a_remapped_endpoint_is_one_difference_of_its_name():
    [one] = compared(changed(running(), "/plan", name="/plan_raw"))
    assert told([one]) == [("publisher /plan of /planner", "name", ("/plan", "/plan_raw"), Reason.REMAPPED)]
    assert one.severity is Severity.WARNING


def test_two_nodes_that_are_alike_are_not_taken_for_one():
    alike = [Endpoint(name, PUBLISHER, "/scan", SCAN, qos=BEST) for name in ("/one", "/two")]
    graph = with_end(without(running(), "/lidar"), *alike)
    graph = msgspec.structs.replace(graph, nodes=(*graph.nodes, Node("/one"), Node("/two")))
    assert all(one.aspect is Aspect.PRESENCE for one in compared(graph))


def test_a_name_with_a_random_end_is_known():
    anonymous = node("/talker_*", end("/talker_*", PUBLISHER, "/chat"), anonymous=True, resolved=False)
    graph = Graph("ros2", (Node("/talker_412"),), (Endpoint("/talker_412", PUBLISHER, "/chat", SCAN, qos=RELIABLE),))
    assert compared(graph, Configuration("l", "ros2", (anonymous,))) == ()


def test_a_name_of_which_source_knows_a_part_explains_what_is_there():
    partly = end("/lidar", PUBLISHER, "/scan/*", resolved=False, given="scan/{a parameter}")
    source = Configuration("l", "ros2", (node("/lidar", partly),))
    graph = Graph("ros2", (Node("/lidar"),), (Endpoint("/lidar", PUBLISHER, "/scan/front", SCAN),))
    [one] = compared(graph, source)
    assert (one.reason, one.severity) == (Reason.PATTERN, Severity.NOTE)
    assert "scan/{a parameter}" in one.why


def test_a_launch_file_that_was_not_read_wholly_accuses_nobody():
    open_ = Unresolved("include", Proof("robot.launch.xml", 9), "its file is not in the workspace", opens=True)
    source = msgspec.structs.replace(ROBOT, unresolved=(open_,))
    [one] = compared(running(nodes=(*running().nodes, Node("/camera"))), source)
    assert (one.reason, one.severity, one.right) == (Reason.INCOMPLETE, Severity.NOTE, "undecided")


def recording(*ends):
    return recorded_side(Graph("ros2", (), ends), "drive.mcap")


def test_a_recording_is_held_against_topics():
    bag = recording(
        Endpoint("", PUBLISHER, "/scan", "sensor_msgs/msg/PointCloud2", qos=BEST),
        Endpoint("", PUBLISHER, "/image", "sensor_msgs/msg/Image"),
    )
    disparities = found(source_side(ROBOT), bag)
    assert told(disparities) == [
        ("topic /scan", "type", (SCAN, "sensor_msgs/msg/PointCloud2"), Reason.CONTRADICTION),
        ("topic /image", "presence", (ABSENT, "sensor_msgs/msg/Image"), Reason.UNKNOWN_TO_SOURCE),
        ("topic /plan", "presence", (ODOM, ABSENT), Reason.NOT_RECORDED),
    ]
    assert [one.severity for one in disparities] == [Severity.ERROR, Severity.WARNING, Severity.NOTE]


def test_a_recording_that_has_the_graph_is_held_against_all_of_it():
    rows = found(source_side(ROBOT), recorded_side(running(nodes=(Node("/lidar"),)), "drive.mcap"))
    assert Reason.NOT_RECORDED not in {one.reason for one in rows}
    planner = next(one for one in rows if one.subject == "node /planner")
    assert (planner.reason, planner.right, planner.severity) == (Reason.NOT_RUNNING, "the source", Severity.ERROR)


def test_three_sides_are_told_in_one_row():
    bag = recording(Endpoint("", PUBLISHER, "/scan", "sensor_msgs/msg/PointCloud2", qos=BEST))
    rows = found(source_side(ROBOT), running_side(running(), "live"), bag)
    assert rows[0].values == (SCAN, SCAN, "sensor_msgs/msg/PointCloud2")


def test_both_generations_at_once_are_refused():
    with pytest.raises(UsageError, match="one generation"):
        found(source_side(ROBOT), running_side(Graph("ros1", (Node("/n"),)), "live"))
    with pytest.raises(UsageError, match="two or three"):
        found(source_side(ROBOT))


NAMES = st.sampled_from(["/a", "/b", "/c"])
ENDS = st.builds(
    Endpoint, NAMES, st.sampled_from([PUBLISHER, SUBSCRIPTION]), st.sampled_from(["/x", "/y"]),
    st.sampled_from([SCAN, ODOM]), qos=st.sampled_from([RELIABLE, BEST, None]),
)  # fmt: skip


@st.composite
def graphs(draw):
    ends = {(one.node, one.role, one.name): one for one in draw(st.lists(ENDS, max_size=8))}.values()
    nodes = sorted({Node(one.node) for one in ends} | {Node(name) for name in draw(st.sets(NAMES))})
    parameters = {one.name: {"rate": draw(st.sampled_from(["1", "2"]))} for one in nodes}
    return Graph("ros2", tuple(nodes), tuple(ends), parameters=parameters)


@given(graphs())
def test_a_system_differs_in_nothing_from_itself(graph):
    assert found(running_side(graph, "one"), running_side(graph, "two")) == ()


@given(graphs(), graphs())
def test_turned_around_each_cell_changes_place_and_nothing_else(one, two):
    there = found(running_side(one, "one"), running_side(two, "two"))
    back = found(running_side(two, "two"), running_side(one, "one"))
    # Of what is renamed the first side gives the name that parts go by.
    if any(row.aspect is Aspect.NAME for row in there):
        assert len(there) == len(back)
        return
    assert {(row.subject, row.aspect, row.values[::-1], row.reason, row.severity) for row in there} == {
        (row.subject, row.aspect, row.values, row.reason, row.severity) for row in back
    }


@given(graphs(), NAMES)
def test_a_node_that_is_renamed_is_never_more_than_gone_and_come(graph, name):
    renamed = msgspec.json.decode(msgspec.json.encode(graph).replace(name.encode(), b"/renamed"), type=Graph)
    there = found(running_side(graph, "one"), running_side(renamed, "two"))
    if not any(node.name == name for node in graph.nodes):
        assert there == ()
        return
    assert {row.node for row in there} <= {name, "/renamed"}
    assert len(there) in (1, 2)
    if len(there) == 1:
        assert there[0].values == (name, "/renamed")
    else:
        assert {row.aspect for row in there} == {Aspect.PRESENCE}


def test_large_systems_of_which_all_names_differ_are_compared_in_a_moment():
    def system(name, number=400):
        nodes = tuple(Node(f"/{name}{one}") for one in range(number))
        ends = [Endpoint(one.name, PUBLISHER, f"/t{at * 7 % 900}", SCAN) for at, one in enumerate(nodes)]
        told = {one.name: {f"p{at}": "1" for at in range(20)} for one in nodes}
        return Graph("ros2", nodes, tuple(ends), parameters=told)

    begun = time.process_time()
    rows = found(running_side(system("a"), "one"), running_side(system("b"), "two"))
    assert turned_s(begun) < 3
    assert {row.aspect for row in rows} == {Aspect.NAME}
