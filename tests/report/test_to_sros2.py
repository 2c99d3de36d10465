from xml.etree import ElementTree as ET

from roslens.model.configuration import Configuration, ConfiguredEndpoint, ConfiguredNode, Proof
from roslens.model.graph import Endpoint, Role
from roslens.report.graph.to_sros2 import to_sros2

_PLACE = Proof("a.launch.py", 3)


def _end(role, name, **more):
    return ConfiguredEndpoint(Endpoint("/rover/base", role, name, "std_msgs/msg/String"), _PLACE, **more)


def _profile(*ends):
    text = to_sros2(Configuration("a -- b-", "ros2", (ConfiguredNode("/rover/base", _PLACE, endpoints=ends),)))
    root = ET.fromstring(text)
    enclave = root.find("enclaves/enclave")
    assert enclave.attrib == {"path": "/rover/base"}
    return text, enclave.find("profiles/profile")


def test_a_node_is_allowed_what_it_does():
    _, profile = _profile(
        _end(Role.PUBLISHER, "/rover/odom"), _end(Role.SUBSCRIPTION, "/cmd"),
        _end(Role.SERVICE_SERVER, "/rover/base/reset"),
        _end(Role.SERVICE_CLIENT, "/map"), _end(Role.ACTION_SERVER, "/rover/go"), _end(Role.ACTION_CLIENT, "/dock"),
    )  # fmt: skip
    assert profile.attrib == {"ns": "/rover", "node": "base"}
    assert [(rules.tag, dict(rules.attrib), [one.text for one in rules]) for rules in profile] == [
        ("topics", {"subscribe": "ALLOW"}, ["/cmd"]),
        ("topics", {"publish": "ALLOW"}, ["odom"]),
        ("services", {"reply": "ALLOW"}, ["~/reset"]),
        ("services", {"request": "ALLOW"}, ["/map"]),
        ("actions", {"execute": "ALLOW"}, ["go"]),
        ("actions", {"call": "ALLOW"}, ["/dock"]),
    ]


def test_a_name_that_is_not_whole_is_allowed_nothing():
    text, profile = _profile(_end(Role.PUBLISHER, "/*/odom", resolved=False))
    assert len(profile) == 0
    assert "<!-- publish /*/odom: a part of its name is unknown -->" in text
