import msgspec
import pytest

from roslens.model.configuration import ConfiguredParameter, Unresolved
from roslens.model.finding import Severity
from roslens.source.rules.graph.parameters.lifecycle_manager import found
from roslens.source.rules.graph.surroundings import Surroundings
from testbed.configured import configuration, launched, node


def _manager(names, name="/manager", **more):
    one = ConfiguredParameter("node_names", names, "string_array", set_type="string_array", set_by=launched(9))
    return node(name, package="nav2_lifecycle_manager", executable="lifecycle_manager", parameters=(one,), **more)


def findings(*nodes, **more):
    return list(found(msgspec.structs.replace(configuration(*nodes), **more), Surroundings()))


def test_a_managed_node_that_nothing_starts_is_told():
    (one,) = findings(_manager("[planner_server, behaviour_server]"), node("/planner_server"), node("/behavior_server"))
    assert (one.severity, one.line) == (Severity.WARNING, 9)
    assert one.message == (
        "/manager manages 'behaviour_server', and nothing starts a node /behaviour_server: bring-up waits for it. Did "
        "you mean /behavior_server?"
    )


@pytest.mark.parametrize("names", ["[a, b]", "[/a, /b]", "['a', 'b']", "[]", "a", "[a, {argument other}]", None])
def test_a_list_that_is_right_or_not_known_is_none(names):
    assert not findings(_manager(names), node("/a"), node("/b"))


def test_names_are_those_of_the_namespace_of_the_manager():
    assert not findings(_manager("[a, b]", "/rover/manager"), node("/rover/a"), node("/rover/b"))
    (one,) = findings(_manager("[a, b]", "/rover/manager"), node("/rover/a"), node("/b"))
    assert "/rover/b" in one.message


def test_nothing_is_said_where_the_launch_is_not_known_in_full():
    nodes = (_manager("[a, b]"), node("/a"))
    assert findings(*nodes)
    assert not findings(*nodes, unresolved=(Unresolved("x", launched(3), "not in the workspace", opens=True),))
    assert not findings(*nodes, node("/*/c", resolved=False))
    # All of them are started elsewhere.
    assert not findings(_manager("[b, c]"), node("/a"))
