import pytest

BEFORE = "#include <interactive_markers/interactive_marker_server.h>"
TOLD = [
    ("publisher", "m/update_full", "visualization_msgs/InteractiveMarkerInit", True),
    ("publisher", "m/update", "visualization_msgs/InteractiveMarkerUpdate", False),
    ("subscription", "m/feedback", "visualization_msgs/InteractiveMarkerFeedback", False),
]


def ends(facts):
    return [(one.role.value, str(one.name), one.type.known, one.latched) for one in facts.endpoints]


@pytest.mark.parametrize("given", ['server("m")', 'server("m", "", false)'])
def test_a_server_of_markers(main_of, given):
    assert ends(main_of(f"interactive_markers::InteractiveMarkerServer {given};", BEFORE)) == TOLD


def test_a_server_of_markers_in_python(units):
    text = """
import rospy
from interactive_markers.interactive_marker_server import InteractiveMarkerServer
rospy.init_node("a")
server = InteractiveMarkerServer("m")
rospy.spin()
"""
    (facts,) = units(a_py=text)
    assert ends(facts) == TOLD


OF_ROS2 = [
    ("publisher", "m/update", "visualization_msgs/msg/InteractiveMarkerUpdate", False),
    ("subscription", "m/feedback", "visualization_msgs/msg/InteractiveMarkerFeedback", False),
    ("service_server", "m/get_interactive_markers", "visualization_msgs/srv/GetInteractiveMarkers", False),
]


def test_that_of_ros2_is_asked_by_a_service(node_of):
    facts = node_of('server_ = std::make_unique<interactive_markers::InteractiveMarkerServer>("m", this);')
    assert ends(facts) == OF_ROS2
    assert [one.qos.depth for one in facts.endpoints if one.qos] == [100, 1]


def test_that_of_rclpy_keeps_more(units):
    text = """
from interactive_markers import InteractiveMarkerServer
from rclpy.node import Node
class A(Node):
    def __init__(self):
        super().__init__("a")
        self.server = InteractiveMarkerServer(self, "m")
"""
    (facts,) = units(a_py=text)
    assert ends(facts) == OF_ROS2
    assert [one.qos.depth for one in facts.endpoints if one.qos] == [100, 100]
