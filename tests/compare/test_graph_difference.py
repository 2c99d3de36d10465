import msgspec
from hypothesis import given
from hypothesis import strategies as st

from roslens.compare.graph_difference import differences
from roslens.model.configuration import (
    Configuration,
    ConfiguredEndpoint,
    ConfiguredNode,
    ConfiguredParameter,
    ConfiguredRemap,
    Proof,
)
from roslens.model.graph import Endpoint, Role
from roslens.model.qos import Qos
from roslens.report.graph.difference_text import to_markdown, to_text

PROOF = Proof("a.cpp", 3)
RELIABLE = Qos("reliable", "volatile", "keep_last", 10)


def configuration(kind="std_msgs/msg/String", qos=RELIABLE, value="1", target="/b", line=3, name="/n"):
    proof = msgspec.structs.replace(PROOF, line=line)
    end = ConfiguredEndpoint(Endpoint(name, Role.PUBLISHER, "/x", kind, qos=qos), proof)
    parameter = ConfiguredParameter("rate", value, access="declared", proof=proof)
    node = ConfiguredNode(
        name, proof, package="pkg", executable="n", endpoints=(end,), parameters=(parameter,),
        remaps=(ConfiguredRemap("a", target, proof),),
    )  # fmt: skip
    return Configuration("t", "ros2", (node,))


def told(**changed):
    return [(one.what, one.name, one.how) for one in differences(configuration(), configuration(**changed))]


def test_each_kind_of_change_is_told():
    assert told(kind="std_msgs/msg/Int32") == [("publisher", "/x", "changed")]
    assert told(qos=Qos("best_effort", "volatile", "keep_last", 10)) == [("publisher", "/x", "changed")]
    assert told(value="2") == [("parameter", "rate", "changed")]
    assert told(target="/c") == [("remapping", "a", "changed")]
    assert told(name="/m") == [("node", "", "added"), ("node", "", "removed")]


def test_places_in_files_are_no_difference():
    assert told(line=9) == []


def test_text_and_table():
    found = differences(configuration(), configuration(value="a|`b`"))
    assert '~   parameter rate: "1" -> "a|`b`"' in to_text(found, "A", "B")
    table = to_markdown(found, "A", "B")
    assert "1 changed" in table
    assert "\\|'b'" in table
    assert "no difference" in to_markdown((), "A", "B")


@given(
    st.sampled_from(["1", "2"]),
    st.sampled_from(["/n", "/m"]),
    st.sampled_from(["1", "2"]),
    st.sampled_from(["/n", "/m"]),
)
def test_turned_around_added_is_removed(value, name, other_value, other_name):
    one, two = configuration(value=value, name=name), configuration(value=other_value, name=other_name)
    turned = {"added": "removed", "removed": "added", "changed": "changed"}
    there = {(d.node, d.what, d.name, d.how, d.before, d.after) for d in differences(one, two)}
    back = {(d.node, d.what, d.name, turned[d.how], d.after, d.before) for d in differences(two, one)}
    assert there == back


def test_an_override_that_nobody_sets_is_told_with_its_endpoint():
    name = "qos_overrides./x.publisher.depth"
    node = configuration().nodes[0]
    declared = ConfiguredParameter(name, "10", "int", access="declared")
    given = msgspec.structs.replace(declared, set_by=Proof("a.yaml", 1))
    with_, set_ = (
        msgspec.structs.replace(
            configuration(), nodes=(msgspec.structs.replace(node, parameters=(*node.parameters, one)),)
        )
        for one in (declared, given)
    )
    assert differences(configuration(), with_) == ()
    assert [(one.what, one.name) for one in differences(with_, set_)] == [("parameter", name)]
