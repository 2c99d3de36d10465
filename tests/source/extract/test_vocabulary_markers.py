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


def test_that_of_ros2_is_another_one(node_of):
    facts = node_of('server_ = std::make_unique<interactive_markers::InteractiveMarkerServer>("m", this);')
    assert ends(facts) == []
