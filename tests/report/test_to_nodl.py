import yaml

from roslens.model.configuration import (
    Configuration,
    ConfiguredEndpoint,
    ConfiguredNode,
    ConfiguredParameter,
    Proof,
)
from roslens.model.graph import Endpoint, Role
from roslens.report.graph.to_nodl import to_nodl


def test_each_node_is_a_document(graph):
    listener, talker = yaml.safe_load_all(to_nodl(graph))
    assert listener["nodl_version"] == talker["nodl_version"] == 2
    assert listener["action_clients"] == [{"name": "/go", "type": "pkg/action/Go"}]
    assert talker["publishers"][0] == {
        "name": "/chatter",
        "type": "std_msgs/msg/String",
        "qos": {"history": "KEEP_LAST", "depth": 10, "reliability": "RELIABLE", "durability": "VOLATILE"},
    }
    assert talker["service_servers"] == [{"name": "/reset", "type": "std_srvs/srv/Empty", "description": "if debug"}]
    assert talker["parameters"] == {
        "rate": {"type": "int", "default_value": 1},
        "name": {"type": "string", "default_value": 'a "b"'},
    }


def test_what_nodl_has_no_word_for_is_left_in_comments(graph):
    text = to_nodl(graph)
    assert "# publishers: /in/* of unknown type (/in/*): unresolved" in text
    assert "# parameter list: its type is unknown" in text


def test_a_parameter_of_any_type_has_none_in_nodl():
    one = ConfiguredParameter("x", access="declared", type="int", dynamic=True)
    text = to_nodl(Configuration("t", "ros2", (ConfiguredNode("/a", Proof("a.cpp", 1), parameters=(one,)),)))
    assert "# parameter x: it may be of any type" in text
    assert "parameters:" not in text


def test_names_that_are_not_whole_are_no_keys():
    one = ConfiguredParameter("*.radius", access="declared", type="double")
    end = ConfiguredEndpoint(Endpoint("/a", Role.SERVICE_CLIENT, "/", "std_srvs/srv/Trigger"), Proof("a.cpp", 1))
    node = ConfiguredNode("/a", Proof("a.cpp", 1), parameters=(one,), endpoints=(end,))
    text = to_nodl(Configuration("t", "ros2", (node,)))
    assert "# parameter *.radius: a part of its name is unknown" in text
    assert yaml.safe_load(text) == {"nodl_version": 2}
