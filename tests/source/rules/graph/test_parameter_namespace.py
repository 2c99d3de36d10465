from roslens.model.configuration import Proof
from roslens.model.finding import Severity
from roslens.source.rules.graph.parameters.parameter_namespace import found
from roslens.source.rules.graph.parameters.parameter_undeclared import found as undeclared
from roslens.source.rules.graph.surroundings import Surroundings
from testbed.configured import configuration, end, launched, node, parameter

CODE = Proof("src/slam.cpp", 12)
SET = {"value": "5", "type": "int", "set_type": "int"}


def read(name, **more):
    return parameter(name, access="read", proof=CODE, **more)


def findings(*nodes, **more):
    return list(found(configuration(*nodes, generation="ros1", **more), Surroundings()))


def test_a_private_parameter_that_is_read_globally_is_a_warning():
    slam = node(
        "/slam", end("sub", "/scan"), parameters=(parameter("/slam/rate", set_by=launched(4), **SET), read("/rate"))
    )
    (one,) = findings(slam)
    assert (one.severity, one.line, one.entity) == (Severity.WARNING, 4, "parameter:/slam:/slam/rate")
    assert one.message == (
        "parameter `/slam/rate` is set (launch/robot.launch.xml:4), but /slam (src/slam.cpp:12) reads `/rate`, which "
        "is not set: the value has no effect. Set it outside of the node, or read `~rate`."
    )
    assert not list(undeclared(configuration(slam, generation="ros1"), Surroundings())), "one mistake is one finding"


def test_what_is_read_in_the_namespace_of_the_node_is_not_private_either():
    slam = node("/robot/slam", parameters=(parameter("/robot/slam/a/b", set_by=launched(), **SET), read("/robot/a/b")))
    assert [one.severity for one in findings(slam)] == [Severity.WARNING]


def test_a_global_parameter_that_is_read_privately_is_a_warning():
    slam = node("/slam", end("sub", "/scan"), parameters=(read("/slam/rate", default="1"),))
    (one,) = findings(slam, parameters=(parameter("/rate", set_by=launched(2), **SET),))
    assert (one.severity, one.line, one.entity) == (Severity.WARNING, 2, "parameter:/slam:/rate")
    assert one.message == (
        "parameter `/rate` is set (launch/robot.launch.xml:2), but /slam (src/slam.cpp:12) reads `/slam/rate`, which "
        "is not set: the value has no effect. Set it within the node, or read `/rate`."
    )


def test_a_global_parameter_may_be_of_a_node_that_is_not_known():
    slam = node("/slam", end("sub", "/scan"), parameters=(read("/slam/rate"),))
    shared = (parameter("/rate", set_by=launched(2), **SET),)
    (one,) = findings(slam, node("/driver", known=False), parameters=shared)
    assert one.severity is Severity.NOTE
    assert "the parameters that /driver read are unknown" in one.message


def test_what_is_read_as_set_or_set_as_read_is_none():
    private = parameter("/slam/rate", set_by=launched(), **SET)
    both = (parameter("/slam/rate", access="read", proof=CODE, set_by=launched(), **SET), read("/rate"))
    assert not findings(node("/slam", parameters=both))
    assert not findings(node("/slam", parameters=(private, read("/slam"), read("/rate"))))
    assert not findings(node("/slam", parameters=(private, read("/rate", set_by=launched(2), **SET))))
    assert not findings(node("/slam", parameters=(private, read("/other"))))
    shared = (parameter("/rate", set_by=launched(2), **SET),)
    user = node("/user", parameters=(read("/rate"),))
    assert not findings(node("/slam", parameters=(read("/slam/rate"),)), user, parameters=shared)


def test_ros2_has_none_outside_of_nodes():
    slam = node("/slam", parameters=(parameter("/slam/rate", set_by=launched(4), **SET), read("/rate")))
    assert not list(found(configuration(slam), Surroundings()))
