from roslens.model.configuration import Unresolved
from roslens.model.finding import Severity
from roslens.source.rules.graph.surroundings import Surroundings
from roslens.source.rules.graph.timing.sim_time import found
from testbed.configured import configuration, end, launched, parameter
from testbed.configured import node as any_node

SIMULATED = (parameter("use_sim_time", value="True", set_by=launched(4)),)
REAL = (parameter("use_sim_time", value="false", set_by=launched(5)),)
UNKNOWN = (parameter("use_sim_time", set_by=launched(6, sure="possible")),)


SCAN = end("sub", "/scan")


def node(name, **more):
    return any_node(name, SCAN, **more)


def findings(*nodes, **more):
    return list(found(configuration(*nodes, **more), Surroundings()))


def test_nodes_without_it_among_nodes_with_it_are_told_once():
    (one,) = findings(
        node("/a", parameters=SIMULATED), node("/b", line=7), node("/c", line=8, parameters=REAL), node("/d", line=9)
    )
    assert one.line == 7
    assert one.message == (
        "use_sim_time is true for /a (launch/robot.launch.xml:4), but not for /b (launch/robot.launch.xml:7), "
        "/c (launch/robot.launch.xml:8, false in launch/robot.launch.xml:5), "
        "/d (launch/robot.launch.xml:9). Set it for all nodes that run together."
    )


def test_all_none_unknown_and_what_needs_no_time_is_none():
    assert not findings(node("/a", parameters=SIMULATED), node("/b", parameters=SIMULATED))
    assert not findings(node("/a", parameters=REAL), node("/b"))
    assert not findings(
        node("/a", parameters=SIMULATED),
        node("/b", parameters=UNKNOWN),
        node("/c", executable="static_transform_publisher"),
        node("/d", package="ros_gz_sim", executable="create"),
        any_node("/e", end("sub", "/cmd_vel", "geometry_msgs/msg/Twist"), end("pub", "/joy", "sensor_msgs/msg/Joy")),
        any_node("/f", SCAN, end("pub", "/clock", "rosgraph_msgs/msg/Clock")),
        any_node("/g", known=False),
    )
    assert not findings(node("/a", parameters=SIMULATED), node("/b"), generation="ros1")
    assert not findings(node("/a", parameters=SIMULATED, conditions=("sim",)), node("/b", conditions=("not sim",)))


def test_what_could_not_be_read_may_set_it():
    missing = Unresolved("other/global.launch.py", launched(2), "it is not in the workspace", opens=True)
    (one,) = findings(node("/a", parameters=SIMULATED), node("/b", line=7), unresolved=(missing,))
    assert one.severity is Severity.NOTE
    assert "what `other/global.launch.py` (launch/robot.launch.xml:2) starts or sets is unknown" in one.message


def test_the_node_inside_of_a_listener_of_transforms_is_none():
    assert not findings(node("/a", parameters=SIMULATED), node("/transform_listener_impl_*"))


def test_a_value_of_its_own_is_told_where_it_is_set():
    (one,) = findings(node("/a", parameters=SIMULATED), node("/c", line=8, parameters=REAL))
    assert (one.path, one.line) == ("launch/robot.launch.xml", 5)
    assert "but not for /c (launch/robot.launch.xml:8, false in launch/robot.launch.xml:5)." in one.message
