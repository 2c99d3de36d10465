import pytest

from roslens.model.qos import Qos

TF = "tf2_msgs/TFMessage"


@pytest.mark.parametrize(
    ("statement", "told"),
    [
        ("tf2_ros::TransformListener l(b);", [("subscription", "/tf", TF), ("subscription", "/tf_static", TF)]),
        ("tf2_ros::TransformBroadcaster b;", [("publisher", "/tf", TF)]),
        ("tf2_ros::StaticTransformBroadcaster b;", [("publisher", "/tf_static", TF)]),
        (
            'message_filters::Subscriber<std_msgs::String> s(nh, "a", 1);',
            [("subscription", "a", "std_msgs/String")],
        ),
        (
            'image_transport::ImageTransport it(nh); auto p = it.advertiseCamera("cam/image", 1);',
            [
                ("publisher", "cam/image", "sensor_msgs/Image"),
                ("publisher", "cam/camera_info", "sensor_msgs/CameraInfo"),
            ],
        ),
        (
            'actionlib::SimpleActionClient<demo::GoAction> c("go", true);',
            [("action_client", "go", "demo/GoAction")],
        ),
        (
            "diagnostic_updater::Updater u;",
            [("publisher", "/diagnostics", "diagnostic_msgs/DiagnosticArray")],
        ),
        (
            "dynamic_reconfigure::Server<demo::Config> s;",
            [
                ("publisher", "~/parameter_descriptions", "dynamic_reconfigure/ConfigDescription"),
                ("publisher", "~/parameter_updates", "dynamic_reconfigure/Config"),
                ("service_server", "~/set_parameters", "dynamic_reconfigure/Reconfigure"),
            ],
        ),
    ],
)
def test_what_they_make(main_of, statement, told):
    facts = main_of(statement)
    assert [(one.role.value, str(one.name), one.type.known) for one in facts.endpoints] == told


def test_where_it_is_used(main_of):
    facts = main_of('auto p = nh.advertise<std_msgs::String>("a", 1);\np.publish(m);\np.publish(m);')
    assert [site.line for site in facts.endpoints[0].sites] == [6, 7]


def test_the_name_of_an_endpoint(main_of):
    body = 'auto p = nh.advertise<std_msgs::String>("a", 1);\n'
    body += 'auto q = nh.advertise<std_msgs::String>(p.getTopic() + "b", 1);'
    assert [str(one.name) for one in main_of(body).endpoints] == ["a", "ab"]


@pytest.mark.parametrize("made", ["it.reset(new {0}(nh));", "it = boost::shared_ptr<{0}>(new {0}(nh));"])
def test_what_a_pointer_is_given(main_of, made):
    kind = "image_transport::ImageTransport"
    facts = main_of(f'boost::shared_ptr<{kind}> it; {made.format(kind)}\nauto p = it->advertise("image", 1);')
    assert [str(one.name) for one in facts.endpoints] == ["image"]


def test_a_listener_of_rclpy_may_be_given_its_topics(units):
    text = """
from rclpy.node import Node
import tf2_ros
class A(Node):
    def __init__(self):
        super().__init__('a')
        topic = self.declare_parameter('topic').value
        self.listener = tf2_ros.TransformListener(tf2_ros.Buffer(), self, tf_topic=topic, tf_static_topic='/other')
        self.usual = tf2_ros.TransformListener(tf2_ros.Buffer(), self)
"""
    (facts,) = units(a_py=text)
    assert [str(one.name) for one in facts.endpoints] == ["{parameter topic}", "/other", "/tf", "/tf_static"]


@pytest.mark.parametrize(
    ("given", "expected"),
    [
        ("", Qos("reliable", "volatile", "keep_last", 10)),
        (", rmw_qos_profile_sensor_data", Qos("best_effort", "volatile", "keep_last", 5)),
        (", rclcpp::QoS(3).best_effort().get_rmw_qos_profile()", Qos("best_effort", "volatile", "keep_last", 3)),
        (", ask()", Qos()),
    ],
)
def test_a_filtered_subscription_has_the_default_quality_unless_it_is_given_one(node_of, given, expected):
    members = "message_filters::Subscriber<std_msgs::msg::String> s_;"
    for body in (
        f's_.subscribe(this, "a"{given});',
        f'message_filters::Subscriber<std_msgs::msg::String> s(this, "a"{given});',
    ):
        (one,) = node_of(body, members).endpoints
        assert (one.qos, bool(one.qos_unknown)) == (expected, expected == Qos())


@pytest.mark.parametrize(
    ("given", "expected"),
    [
        ("", Qos("reliable", "volatile", "keep_last", 10)),
        (", qos_profile=qos_profile_sensor_data", Qos("best_effort", "volatile", "keep_last", 5)),
        (", qos_profile=3", Qos("reliable", "volatile", "keep_last", 3)),
        (", qos_profile=ask()", Qos()),
    ],
)
def test_a_filtered_subscription_of_python(units, given, expected):
    text = f"""
import message_filters
from rclpy.node import Node
from rclpy.qos import qos_profile_sensor_data
from std_msgs.msg import String
class A(Node):
    def __init__(self):
        super().__init__('a')
        self.s = message_filters.Subscriber(self, String, 'a'{given})
"""
    (facts,) = [one for one in units(a_py=text) if one.unit == "A"]
    assert [one.qos for one in facts.endpoints] == [expected]
