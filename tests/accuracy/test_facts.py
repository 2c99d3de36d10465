from accuracy.facts import NODE, OUTSIDE, PARAMETER, Fact, said, seen
from roslens.model.configuration import (
    Configuration,
    ConfiguredEndpoint,
    ConfiguredNode,
    ConfiguredParameter,
    Origin,
    Proof,
)
from roslens.model.graph import Endpoint, Graph, Node, Role
from roslens.model.qos import Qos

HERE = Proof("a.py", 3)


def keys(facts):
    return [one.key for one in facts]


def test_a_running_graph_becomes_facts_of_nodes_ends_and_parameters():
    end = Endpoint("/n", Role.PUBLISHER, "/t", "std_msgs/msg/Bool", "RIHS01_1", Qos("reliable", deadline_s=0.5))
    graph = Graph("ros2", (Node("/n"),), (end,), parameters={"/n": {"rate": "5", "use_sim_time": "false"}})
    node, parameter, publisher = seen(graph)
    assert node == Fact(NODE, "/n")
    assert parameter == Fact(PARAMETER, "/n", "rate", {"value": "5"})
    assert publisher.values == {
        "type": "std_msgs/msg/Bool", "hash": "RIHS01_1", "reliability": "reliable", "deadline": "0.5",
        "lifespan": "none", "lease": "none", "liveliness": "automatic",
    }  # fmt: skip


def test_the_five_topics_of_an_action_of_ros1_are_one_action():
    def end(role, part, kind=""):
        return Endpoint("/n", role, f"/move/{part}", kind)

    ends = [end(Role.SUBSCRIPTION, "goal", "p/MoveActionGoal"), end(Role.SUBSCRIPTION, "cancel")]
    ends += [end(Role.PUBLISHER, part) for part in ("status", "result", "feedback")]
    (action,) = seen(Graph("ros1", (), tuple(ends)))
    assert (action.kind, action.name, action.values) == ("action_server", "/move", {"type": "p/MoveAction"})
    assert len(seen(Graph("ros1", (), tuple(ends[:-1])))) == 4


def test_topics_of_an_action_of_ros2_are_part_of_it():
    ends = (
        Endpoint("/n", Role.ACTION_SERVER, "/move"),
        Endpoint("/n", Role.PUBLISHER, "/move/_action/status"),
    )
    assert keys(seen(Graph("ros2", (), ends))) == [("action_server", "/n", "/move")]


def test_parameters_of_ros1_are_those_of_the_server_and_not_what_is_only_read():
    parameters = (
        ConfiguredParameter("/n/set", "1", set_by=HERE),
        ConfiguredParameter("/n/read", "2", access="read", proof=HERE),
        ConfiguredParameter("/n/written", access="written", proof=HERE, written_by=HERE),
    )
    told = said(Configuration("x", "ros1", (ConfiguredNode("/n", HERE, parameters=parameters),)))
    assert keys(told) == [("node", "/n", ""), (PARAMETER, OUTSIDE, "/n/set"), (PARAMETER, OUTSIDE, "/n/written")]


def test_parameters_of_ros2_are_those_that_a_node_declares():
    parameters = (
        ConfiguredParameter("set", "1", set_by=HERE),
        ConfiguredParameter("declared", "2", access="declared", proof=HERE),
    )
    told = said(Configuration("x", "ros2", (ConfiguredNode("/n", HERE, parameters=parameters),)))
    assert keys(told) == [("node", "/n", ""), (PARAMETER, "/n", "declared")]


def test_what_a_nodelet_has_is_of_its_manager():
    end = ConfiguredEndpoint(Endpoint("/let", Role.PUBLISHER, "/t"), HERE)
    nodes = (
        ConfiguredNode("/manager", HERE, kind="container"),
        ConfiguredNode("/let", HERE, kind="nodelet", container="/manager", endpoints=(end,)),
    )
    assert keys(said(Configuration("x", "ros1", nodes))) == [("node", "/manager", ""), ("publisher", "/manager", "/t")]


def test_a_random_end_of_a_name_leaves_it_known_and_any_other_hole_does_not():
    end = ConfiguredEndpoint(Endpoint("/n_*", Role.PUBLISHER, "/n_*/t"), HERE, resolved=False)
    node = ConfiguredNode("/n_*", HERE, resolved=False, anonymous=True, endpoints=(end,))
    assert [one.resolved for one in said(Configuration("x", "ros1", (node,)))] == [True, True]
    node = ConfiguredNode("/*", HERE, resolved=False, anonymous=True)
    assert [one.resolved for one in said(Configuration("x", "ros1", (node,)))] == [False]


def test_of_one_thing_said_twice_the_surer_word_counts():
    def end(**more):
        return ConfiguredEndpoint(Endpoint("/n", Role.PUBLISHER, "/t"), HERE, **more)

    node = ConfiguredNode("/n", HERE, endpoints=(end(conditions=("x",)), end()))
    assert [one.conditions for one in said(Configuration("x", "ros1", (node,)))] == [(), ()]


def test_what_every_node_has_is_marked():
    end = ConfiguredEndpoint(Endpoint("/n", Role.PUBLISHER, "/rosout"), Proof(origin=Origin.IMPLICIT))
    (_, found) = said(Configuration("x", "ros1", (ConfiguredNode("/n", HERE, endpoints=(end,)),)))
    assert found.implicit
