def test_endpoints_of_rclcpp(node_of):
    body = """
a_ = create_publisher<std_msgs::msg::String>("a", 1);
b_ = create_subscription<std_msgs::msg::String>("b", 1, [](std_msgs::msg::String::SharedPtr) {});
c_ = create_service<std_srvs::srv::Trigger>("~/c", [](int) {});
d_ = create_client<std_srvs::srv::Trigger>("d");
e_ = rclcpp_action::create_server<demo::action::Go>(this, "e", g, h, i);
f_ = rclcpp_action::create_client<demo::action::Go>(this, "f");
"""
    assert [(one.role.value, one.name.known, one.type.known) for one in node_of(body).endpoints] == [
        ("publisher", "a", "std_msgs/msg/String"),
        ("subscription", "b", "std_msgs/msg/String"),
        ("service_server", "~/c", "std_srvs/srv/Trigger"),
        ("service_client", "d", "std_srvs/srv/Trigger"),
        ("action_server", "e", "demo/action/Go"),
        ("action_client", "f", "demo/action/Go"),
    ]


def test_helpers_that_take_the_interfaces_of_a_node(node_of):
    body = 'p_ = rclcpp::create_publisher<std_msgs::msg::String>(get_node_topics_interface(), "a", 1);'
    assert [one.name.known for one in node_of(body).endpoints] == ["a"]


def test_groups(node_of):
    body = "auto group = create_callback_group(rclcpp::CallbackGroupType::Reentrant);\n"
    body += 'c_ = create_client<std_srvs::srv::Trigger>("d", rclcpp::ServicesQoS(), group);'
    (one,) = node_of(body).endpoints
    assert one.group == "Reentrant:5"


def test_rclpy(units):
    text = """
import rclpy
from rclpy.action import ActionClient
from rclpy.node import Node
from rclpy.qos import QoSProfile, ReliabilityPolicy, qos_profile_sensor_data
from std_msgs.msg import String
from demo.action import Go
class A(Node):
    def __init__(self):
        super().__init__('a', namespace='space')
        self.create_publisher(String, 'a', QoSProfile(depth=2, reliability=ReliabilityPolicy.BEST_EFFORT))
        self.create_subscription(String, 'b', self.heard, qos_profile_sensor_data)
        ActionClient(self, Go, 'go')
        self.declare_parameters('group', [('x', 1), ('y', 'z')])
        self.create_timer(0.1, self.tick)
    def heard(self, message): pass
    def tick(self): pass
"""
    (facts,) = units(a_py=text)
    assert (facts.name.known, facts.namespace.known) == ("a", "space")
    assert [(e.role.value, e.name.known, e.qos and (e.qos.reliability, e.qos.depth)) for e in facts.endpoints] == [
        ("publisher", "a", ("best_effort", 2)),
        ("subscription", "b", ("best_effort", 5)),
        ("action_client", "go", None),
    ]
    assert [(str(one.name), one.type) for one in facts.parameters] == [("group.x", "int"), ("group.y", "string")]
    assert [(one.period_s, one.callback) for one in facts.timers] == [(0.1, "A.tick")]
