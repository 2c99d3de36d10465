from hypothesis import given
from hypothesis import strategies as st

from roslens.model.configuration import Configuration
from roslens.source.rules.graph.findings import RULES, graph_findings
from roslens.source.rules.graph.surroundings import Surroundings
from testbed.configured import RELIABLE, SENSOR, configuration, end, node, remap

NODES = st.lists(
    st.builds(
        lambda name, ends: node(name, *ends),
        st.sampled_from(["/a", "/b", "/c"]),
        st.lists(
            st.builds(
                end,
                st.sampled_from(["pub", "sub", "serve", "call"]),
                st.sampled_from(["/scan", "/scan1", "/cmd_vel", "/ns/scan"]),
                st.sampled_from(["", "m/A", "m/B"]),
                st.integers(1, 5),
                qos=st.sampled_from([None, SENSOR, RELIABLE]),
                sure=st.sampled_from(["certain", "likely", "possible"]),
            ),
            max_size=4,
        ),
    ),
    max_size=4,
    unique_by=lambda one: one.name,
)


def test_all_rules_look_at_one_configuration():
    known = configuration(
        node("/lidar", end("pub", "/scan", qos=SENSOR), remaps=(remap("sacn", "x"),)),
        node("/slam", end("sub", "/scan", given="scan", qos=RELIABLE)),
        node("/nav", end("sub", "/odom", given="odom")),
    )
    found = graph_findings(known)
    assert [(one.path, one.rule) for one in found] == [
        ("launch/robot.launch.xml", "graph.remap"),
        ("src/lidar.cpp", "graph.global_name"),
        ("src/nav.cpp", "graph.one_end"),
        ("src/slam.cpp", "graph.qos"),
    ]


def test_nothing_is_wrong_with_nothing():
    assert graph_findings(Configuration("", "ros2")) == []


@given(NODES, st.randoms())
def test_the_order_of_nodes_does_not_matter(nodes, random):
    shuffled = random.sample(nodes, len(nodes))
    known, other = Configuration("", "ros2", tuple(nodes)), Configuration("", "ros2", tuple(shuffled))
    assert graph_findings(known) == graph_findings(other)


@given(NODES)
def test_each_finding_has_a_place_an_entity_and_a_fingerprint_of_its_own(nodes):
    found = graph_findings(Configuration("", "ros2", tuple(nodes)))
    assert all(one.path and one.line and one.entity and one.fingerprint for one in found)
    assert {one.rule for one in found} <= {rule.id for rule, _ in RULES}


def test_what_may_never_run_together():
    known = configuration(
        node("/a", end("pub", "/scan", "m/A", qos=SENSOR), end("pub", "/cmd_vel", "m/T")),
        node("/a", end("sub", "/scan", "m/B", qos=RELIABLE)),
        node("/b", end("pub", "/cmd_vel", "m/T")),
    )
    together = {one.rule: one.severity.value for one in graph_findings(known)}
    apart = graph_findings(known, Surroundings(together=False))
    assert {"graph.node_name", "graph.type", "graph.qos", "graph.command_topic"} <= together.keys()
    assert {one.rule: one.severity.value for one in apart} == {
        "graph.type": "note",
        "graph.qos": "note",
        "graph.global_name": "note",
    } | {one: value for one, value in together.items() if one in ("graph.private_data", "graph.queue")}
    assert all("no launch file states" in one.message for one in apart if one.rule in ("graph.type", "graph.qos"))
