"""Servers of interactive markers, of both generations."""


def told(facts):
    return [(one.role.value, str(one.name), one.type.known) for one in facts.endpoints]


def test_markers_of_ros_2(node_of):
    facts = node_of('server_ = std::make_unique<interactive_markers::InteractiveMarkerServer>("tool", this);')
    assert told(facts) == [
        ("publisher", "tool/update", "visualization_msgs/msg/InteractiveMarkerUpdate"),
        ("subscription", "tool/feedback", "visualization_msgs/msg/InteractiveMarkerFeedback"),
        ("service_server", "tool/get_interactive_markers", "visualization_msgs/srv/GetInteractiveMarkers"),
    ]
    assert [one.qos.depth for one in facts.endpoints if one.qos] == [100, 1]


def test_markers_of_ros_1(main_of):
    facts = main_of('interactive_markers::InteractiveMarkerServer server("tool");')
    assert told(facts) == [
        ("publisher", "tool/update", "visualization_msgs/InteractiveMarkerUpdate"),
        ("publisher", "tool/update_full", "visualization_msgs/InteractiveMarkerInit"),
        ("subscription", "tool/feedback", "visualization_msgs/InteractiveMarkerFeedback"),
    ]
    assert [(one.queue, one.latched) for one in facts.endpoints] == [(100, False), (100, True), (100, False)]


def test_markers_of_rclpy(units):
    text = """
from interactive_markers import InteractiveMarkerServer
from rclpy.node import Node
class A(Node):
    def __init__(self):
        super().__init__('a')
        self.server = InteractiveMarkerServer(self, 'tool')
"""
    (facts,) = units(a_py=text)
    assert [(str(one.name), one.qos.depth if one.qos else None) for one in facts.endpoints] == [
        ("tool/update", 100),
        ("tool/feedback", 100),
        ("tool/get_interactive_markers", None),
    ]


def test_a_name_that_is_not_known(main_of):
    facts = main_of("interactive_markers::InteractiveMarkerServer server(name_of());")
    assert [one.name.holes != () for one in facts.endpoints] == [True, True, True]
