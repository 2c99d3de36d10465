"""What a running system tells of an entity, from made graphs."""

import pytest

from roslens.compare.why.answered import answer
from roslens.compare.why.declared import Declared
from roslens.compare.why.observed import Ended, Observed, ObservedTransforms
from roslens.compare.why.question import Question
from roslens.compare.why.recorded import RecordedTransforms
from roslens.model.answers.answer import Asks, StepState
from roslens.model.answers.ros_process import RosProcess
from roslens.model.configuration import Configuration, ConfiguredEndpoint, ConfiguredNode, Proof
from roslens.model.graph import Endpoint, Graph, Instance, Node, Role
from roslens.model.qos import Qos
from roslens.model.transforms.transform import Transform
from roslens.model.transforms.tree import tree_of

SCAN = Question("topic", "/scan")
BEST, RELIABLE = Qos("best_effort", "volatile"), Qos("reliable", "volatile")


def publisher(node="/lidar", kind="sensor_msgs/msg/LaserScan", qos=BEST, digest=""):
    return Endpoint(node, Role.PUBLISHER, "/scan", kind, digest, qos)


def subscription(node="/planner", kind="sensor_msgs/msg/LaserScan", qos=BEST, digest=""):
    return Endpoint(node, Role.SUBSCRIPTION, "/scan", kind, digest, qos)


def observed(*ends, nodes=(), **more):
    names = {one.node for one in ends} - {one.name for one in nodes}
    graph = Graph("ros2", (*nodes, *map(Node, sorted(names))), ends)
    return Observed("what runs here, domain 0", graph, seconds=4.0, **more)


def source():
    end = ConfiguredEndpoint(Endpoint("/lidar", Role.PUBLISHER, "/scan"), Proof("lidar.cpp", 7))
    node = ConfiguredNode("/lidar", Proof("robot.launch.py", 3), package="drivers", executable="lidar_node",
                          defined=Proof("lidar.cpp", 1), endpoints=(end,))  # fmt: skip
    return Declared("robot.launch.py", Configuration("robot.launch.py", "ros2", (node,)))


def cause(live, declared=None, question=SCAN):
    return answer(question, declared, None, live).cause


def test_what_flows_has_no_cause():
    values = {"topic:/scan": {"rate": 10.0, "rate_received": 10.0}}
    found = answer(SCAN, None, None, observed(publisher(), subscription(), values=values))
    assert found.cause is None
    assert [one.asks for one in found.steps if one.state is StepState.OK and one.of == "live"] == [
        Asks.EXISTS, Asks.MADE, Asks.USED, Asks.RUNS, Asks.TYPE, Asks.QOS, Asks.SENT, Asks.RECEIVED,
    ]  # fmt: skip


def test_a_maker_of_source_that_does_not_run_is_named():
    found = cause(observed(subscription()), source())
    assert found.asks is Asks.MADE
    assert found.says == (
        "no node that is seen publishes it: /lidar, which should make it, does not run or is not seen"
    )
    assert found.command == "ros2 run drivers lidar_node"


def test_a_maker_that_ended_says_how_and_its_last_words():
    ended = Ended("/lidar", "was ended by signal 11", ("serial port is gone",))
    found = cause(observed(subscription(), ended=(ended,)), source())
    assert "/lidar ended: was ended by signal 11" in found.says
    assert found.evidence == ("serial port is gone",)


def test_a_maker_in_another_domain_is_named_with_both_domains():
    process = RosProcess(42, "/opt/lib/drivers/lidar_node", 1000, domain="5")
    found = cause(observed(subscription(), processes=(process,)), source())
    assert "/lidar runs apart from what was looked at: ROS_DOMAIN_ID is 5, looked at is 0" in found.says
    assert "(process 42)" in found.evidence[0]
    assert found.command == "roslens why /scan --live --domain 5"


@pytest.mark.parametrize(
    ("process", "said"),
    [
        (RosProcess(1, "x", 0, rmw="rmw_cyclonedds_cpp"), "RMW_IMPLEMENTATION is rmw_cyclonedds_cpp"),
        (RosProcess(1, "x", 0, discovery="OFF"), "ROS_AUTOMATIC_DISCOVERY_RANGE is OFF"),
    ],
)
def test_programs_that_run_apart_are_told_without_source_too(process, said):
    found = cause(observed(subscription(), processes=(process,), here={"RMW_IMPLEMENTATION": "rmw_fastrtps_cpp"}))
    assert "1 program of ROS 2 on this host cannot meet" in found.says
    assert said in found.evidence[0]


def test_the_same_domain_is_not_apart_whether_it_is_written_or_not():
    live = observed(publisher(), processes=(RosProcess(1, "x", 0, domain="0"), RosProcess(2, "y", 0)))
    (found,) = (one for one in answer(SCAN, None, None, live).steps if one.asks is Asks.REACHED)
    assert found.state is StepState.OK


@pytest.mark.parametrize(("state", "verb"), [("unconfigured", "configure"), ("inactive", "activate")])
def test_a_managed_node_that_is_not_active_is_the_cause(state, verb):
    found = cause(observed(publisher(), subscription(), nodes=(Node("/lidar", lifecycle=state),)))
    assert found.says.startswith(f"/lidar is {state}")
    assert found.command == f"ros2 lifecycle set /lidar {verb}"


def test_two_nodes_of_one_name_are_a_cause():
    twin = Node("/lidar", instances=(Instance("here", 4), Instance("here", 5)))
    assert "2 nodes are called /lidar" in cause(observed(publisher(), nodes=(twin,))).says


def test_types_and_versions_of_types_that_differ_are_causes():
    assert "2 types" in cause(observed(publisher(), subscription(kind="std_msgs/msg/String"))).says
    assert "2 versions of" in cause(observed(publisher(digest="RIHS01_a"), subscription(digest="RIHS01_b"))).says


def test_quality_of_service_is_judged_by_pairs():
    live = observed(publisher(), subscription(qos=RELIABLE))
    assert cause(live).asks is Asks.QOS
    live = observed(publisher(), publisher("/other", qos=RELIABLE), subscription(qos=RELIABLE))
    assert cause(live) is None


def test_silence_and_loss_are_causes_and_what_was_not_counted_is_none():
    ends = (publisher(), subscription())
    assert cause(observed(*ends)) is None
    silent = cause(observed(*ends, values={"topic:/scan": {"rate": 0.0}}))
    assert (silent.asks, silent.says) == (Asks.SENT, "no message came in 4.0 s, though somebody publishes it")
    lost = cause(observed(*ends, values={"topic:/scan": {"rate": 9.0, "loss": 30.0}}))
    assert (lost.asks, lost.says) == (Asks.RECEIVED, "30.0 % of the messages did not arrive")


def test_a_node_that_does_not_run_has_the_nearest_names():
    live = observed(publisher("/lidar_front"))
    found = cause(live, None, Question("node", "/lidar_fron"))
    assert (found.asks, found.how) == (Asks.EXISTS, "nearest names that are there: /lidar_front")
    assert cause(live, None, Question("node", "/lidar_front")) is None


def test_a_maker_that_runs_under_another_remapping_is_named_with_what_it_makes():
    other = Endpoint("/lidar", Role.PUBLISHER, "/laser_7/points", "sensor_msgs/msg/LaserScan")
    found = cause(observed(subscription(), other), source())
    assert found.says.endswith("/lidar, which should make it, publishes /laser_7/points instead")
    assert "lidar.cpp:7" in found.evidence[0]
    assert found.evidence[1] == "started at robot.launch.py:3"


def test_a_near_name_of_the_same_type_that_nobody_uses_is_named_without_source():
    typo = Endpoint("/lidar", Role.PUBLISHER, "/sacn", "sensor_msgs/msg/LaserScan")
    found = cause(observed(subscription(), typo))
    assert (found.says, found.how) == (
        "no node that is seen publishes it: /lidar publishes /sacn, which nobody else uses",
        "correct or remap one of the two names: /sacn and /scan",
    )
    used = Endpoint("/viewer", Role.SUBSCRIPTION, "/sacn", "sensor_msgs/msg/LaserScan")
    assert "/sacn, which nobody" not in cause(observed(subscription(), typo, used)).says
    text = Endpoint("/lidar", Role.PUBLISHER, "/sacn", "std_msgs/msg/String")
    assert "/sacn, which nobody" not in cause(observed(subscription(), text)).says


def test_a_node_on_simulated_time_without_a_clock_is_the_cause():
    clock = Endpoint("/lidar", Role.SUBSCRIPTION, "/clock", "rosgraph_msgs/msg/Clock")
    found = cause(observed(publisher(), subscription(), clock))
    assert found.says == "/lidar waits for simulated time, and nobody publishes /clock"
    assert found.command == "ros2 param set /lidar use_sim_time false"
    told = Endpoint("/gazebo", Role.PUBLISHER, "/clock", "rosgraph_msgs/msg/Clock")
    assert cause(observed(publisher(), subscription(), clock, told)) is None
    of_another = Endpoint("/viewer", Role.SUBSCRIPTION, "/clock", "rosgraph_msgs/msg/Clock")
    assert cause(observed(publisher(), subscription(), of_another)) is None


def test_that_source_has_not_what_is_seen_is_no_cause():
    ends = (Endpoint("/camera", Role.PUBLISHER, "/image"), Endpoint("/viewer", Role.SUBSCRIPTION, "/image"))
    question = Question("topic", "/image")
    found = answer(question, source(), None, observed(*ends))
    assert found.cause is None
    assert [one.state for one in found.steps if one.of == "source"] == [StepState.UNSEEN]
    assert cause(observed(ends[1]), source(), question).asks is Asks.MADE


def two_users(sends, receives, *, closed=frozenset({1000}), **more):
    """Return a lidar of one user and a planner of another, on one host."""
    nodes = (Node("/lidar", "here", 7), Node("/planner", "here", 8))
    processes = (RosProcess(7, "lidar", sends, **more), RosProcess(8, "planner", receives, **more))
    return observed(publisher(), subscription(), nodes=nodes, processes=processes, closed_memory=closed)


def test_a_subscription_of_another_user_gets_nothing_through_memory_it_may_not_write():
    found = cause(two_users(1000, 1001))
    assert (found.asks, found.says) == (
        Asks.REACHED, "/planner can receive nothing: it runs as user 1001, and /lidar as 1000",
    )  # fmt: skip
    assert "FASTDDS_BUILTIN_TRANSPORTS=UDPv4" in found.how


def test_transports_that_are_chosen_do_not_count_where_discovery_stays_on_the_host():
    assert cause(two_users(1000, 1001, transports="UDPv4", discovery="LOCALHOST")).asks is Asks.REACHED


@pytest.mark.parametrize(
    "live",
    [
        two_users(1000, 1000),
        two_users(1000, 0),
        two_users(1000, 1001, closed=frozenset()),
        two_users(1000, 1001, transports="UDPv4"),
        two_users(1000, 1001, rmw="rmw_cyclonedds_cpp"),
    ],
    ids=["one user", "root", "memory that all may write", "no shared memory", "another middleware"],
)
def test_users_who_reach_each_other_are_no_cause(live):
    assert cause(live) is None


def test_zenoh_without_a_router_is_the_cause_where_nobody_is_seen():
    zenoh = {
        "here": {"RMW_IMPLEMENTATION": "rmw_zenoh_cpp"},
        "processes": (RosProcess(1, "x", 0, rmw="rmw_zenoh_cpp"),),
    }
    found = cause(observed(**zenoh))
    assert found.says.startswith("nobody that is seen uses /scan: no router of Zenoh runs here")
    assert "no router of Zenoh" in cause(observed(subscription(), **zenoh), source()).says
    assert cause(observed(publisher(), subscription(), **zenoh)) is None
    assert "router" not in cause(observed(routers=1, **zenoh)).says
    assert "router" not in cause(observed(**(zenoh | {"here": {}}))).says


def test_a_maker_in_another_domain_is_named_where_nobody_else_is_seen():
    process = RosProcess(42, "/opt/lib/drivers/lidar_node", 1000, domain="5")
    assert "/lidar runs apart" in cause(observed(processes=(process,)), source()).says


def test_a_program_of_another_user_whose_nodes_are_not_seen_is_told():
    process = RosProcess(9, "lidar_node", 1001)
    live = observed(subscription(), processes=(process,), closed_memory=frozenset({1001}), user=1000)
    assert "it runs as user 1001, looked at was as user 1000" in cause(live, source()).says
    assert "user 1001" not in cause(
        observed(subscription(), processes=(process,), closed_memory=frozenset(), user=1000), source()
    ).says  # fmt: skip


def heard(*pairs):
    """Return transforms between frames, said 50 times in a second."""
    said = [Transform(*pair, round(at * 2e7), received=round(at * 2e7)) for at in range(50) for pair in pairs]
    return ObservedTransforms(RecordedTransforms(tree_of(said), ("/tf",)), 0.0, 1.0)


def test_transforms_of_what_runs_read_as_of_what_runs():
    question = Question("transform", "map->laser")
    found = answer(question, None, None, observed(transforms=heard(("map", "base"), ("base", "laser"))))
    assert found.cause is None
    assert {one.of for one in found.steps} == {"live"}
    apart = cause(observed(transforms=heard(("map", "base"), ("dock", "laser"))), None, question)
    assert apart.says == "map and laser are in two trees: nothing says where dock is in that of map"
    assert apart.how.endswith("/tf_static is not there, and may have it")
    nobody = ObservedTransforms(RecordedTransforms(tree_of(())), 0.0, 1.0)
    assert "nobody publishes transforms" in cause(observed(transforms=nobody), None, question).says
    (unheard,) = answer(question, None, None, observed(failures=("no tf2_msgs",))).steps
    assert (unheard.state, unheard.evidence) == (StepState.UNSEEN, ("no tf2_msgs",))
