import pytest

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
