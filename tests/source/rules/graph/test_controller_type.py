import msgspec

from roslens.model.configuration import Unresolved
from roslens.model.finding import Severity
from roslens.source.rules.graph.parameters.controller_type import found
from roslens.source.rules.graph.surroundings import Surroundings
from testbed.configured import configuration, launched, node, parameter

REASON = "no parameter file states its type; its endpoints are unknown"


def findings(*names, generation="ros1", spawner="/rover/spawner", unresolved=("arm",), **more):
    nodes = (node(spawner, package="controller_manager", executable="spawner", line=5, **more),)
    held = tuple(parameter(name, value="x", set_by=launched(2, "config/control.yaml")) for name in names)
    missing = tuple(Unresolved(f"controller {name}", launched(5), REASON) for name in unresolved)
    whole = configuration(*nodes, generation=generation, parameters=held)
    return list(found(msgspec.structs.replace(whole, unresolved=missing), Surroundings()))


def test_a_type_in_another_namespace_is_told():
    (one,) = findings("/robot/arm/type", "/robot/arm/joint")
    assert (one.severity, one.line) == (Severity.WARNING, 5)
    assert one.message == (
        "/rover/spawner loads controller 'arm' and reads its type from /rover/arm/type, which is not set; "
        "/robot/arm/type is (config/control.yaml:2). Use the same namespace for both."
    )


def test_a_condition_lowers_it():
    (one,) = findings("/robot/arm/type", conditions=("sim",))
    assert one.severity is Severity.NOTE


def test_nothing_is_said_where_no_type_is_known_or_the_right_one_is_set():
    assert not findings("/robot/arm/joint")
    assert not findings("/rover/arm/type", "/robot/arm/type")
    assert not findings("/robot/forearm/type")
    assert not findings("/robot/arm/type", unresolved=())
    assert not findings("/robot/arm/type", generation="ros2")
