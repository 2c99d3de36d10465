"""Names against the rules of rcl (`rcl_validate_topic_name`) and of roscpp (`ros::names::validate`)."""

import pytest

from roslens.source.rules.node.naming.names import node_fault, topic_fault


@pytest.mark.parametrize("name", ["a", "/a/b_c", "~", "~/a", "a/{node}/b", "{node}_a", "A1", "_a"])
def test_ros_2_takes_it(name):
    assert topic_fault(name, ros1=False) == ""


@pytest.mark.parametrize(
    "name", ["", "a-b", "a b", "~a", "a/~/b", "a//b", "a/", "1a", "a/1b", "/1a", "~/1a", "a.b", "é"]
)
def test_ros_2_refuses_it(name):
    assert topic_fault(name, ros1=False)


@pytest.mark.parametrize("name", ["a", "/a/b", "~a", "~/a", "a/", "a//b", "a/1b", "/1a", "~1a", "~/1a"])
def test_ros_1_takes_it(name):
    assert topic_fault(name, ros1=True) == ""


@pytest.mark.parametrize("name", ["a-b", "a b", "1a", "a.b"])
def test_ros_1_refuses_it(name):
    assert topic_fault(name, ros1=True)


@pytest.mark.parametrize(
    ("name", "fine"), [("arm", True), ("_a1", True), ("1a", False), ("a-b", False), ("a/b", False), ("", False)]
)
def test_names_of_nodes(name, fine):
    assert (node_fault(name) == "") is fine
