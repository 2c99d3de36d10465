import pytest

from roslens.source.extract.symbolic.condition import as_written


@pytest.mark.parametrize(
    ("statement", "told"),
    [
        ('auto p = nh.advertise<std_msgs::String>("a", 5, true);', ("publisher", "a", "std_msgs/String", 5, True)),
        ('auto s = nh.subscribe("a", 7, heard);', ("subscription", "a", "std_msgs/String", 7, False)),
        ('auto s = nh.advertiseService("a", serve);', ("service_server", "a", "std_srvs/Empty", -1, False)),
        ('auto c = nh.serviceClient<std_srvs::Empty>("a");', ("service_client", "a", "std_srvs/Empty", -1, False)),
        ('ros::service::call<std_srvs::Empty>("a", x);', ("service_client", "a", "std_srvs/Empty", -1, False)),
        ('ros::topic::waitForMessage<std_msgs::String>("a");', ("subscription", "a", "std_msgs/String", -1, False)),
    ],
)
def test_endpoints_of_roscpp(main_of, statement, told):
    before = "void heard(const std_msgs::String::ConstPtr & m) {}\n"
    before += "bool serve(std_srvs::Empty::Request & q, std_srvs::Empty::Response & a) { return true; }"
    facts = main_of(statement, before)
    assert [(e.role.value, str(e.name), e.type.known, e.queue, e.latched) for e in facts.endpoints] == [told]
    assert facts.name.known == "a"


def test_handles_below_handles(main_of):
    body = 'ros::NodeHandle p("~"), q(p, "b"), r("/c/");\n'
    body += 'for (auto h : {p, q, r}) { auto s = h.advertise<std_msgs::String>("x", 1); }'
    assert [str(one.name) for one in main_of(body).endpoints] == ["~/x", "~/b/x", "/c/x"]


def test_parameters_of_roscpp(main_of):
    body = 'std::string t, u; nh.param<std::string>("t", t, "x"); nh.getParam("u", u); nh.setParam("w", 1);\n'
    facts = main_of(body + "auto p = nh.advertise<std_msgs::String>(t + u, 1);")
    assert [(str(one.name), one.access) for one in facts.parameters] == [("t", "read"), ("u", "read"), ("w", "written")]
    assert str(facts.endpoints[0].name) == "{parameter t}{parameter u}"


def test_the_type_that_the_code_asks_for_is_that_of_the_parameter(main_of):
    facts = main_of(
        'bool b; float f; nh.param<bool>("b", b, "false"); nh.param<float>("f", f, 1); nh.param("s", b, "x");'
    )
    assert [(str(one.name), one.type) for one in facts.parameters] == [("b", "bool"), ("f", "double"), ("s", "string")]


def test_a_name_with_a_random_end(units):
    text = (
        '#include <ros/ros.h>\nint main(int c, char ** v) { ros::init(c, v, "a", ros::init_options::AnonymousName); }'
    )
    (facts,) = units(a_cpp=text)
    assert str(facts.name) == "a_{random end}"


def test_a_nodelet(units):
    text = """
#include <nodelet/nodelet.h>
#include <std_msgs/String.h>
class N : public nodelet::Nodelet { void onInit() {
  pub_ = getPrivateNodeHandle().advertise<std_msgs::String>("a", 1);
  sub_ = getNodeHandle().subscribe<std_msgs::String>("b", 1, &N::heard, this); }
  void heard(const std_msgs::String::ConstPtr & m) { pub_.publish(*m); } ros::Publisher pub_; };
PLUGINLIB_EXPORT_CLASS(N, nodelet::Nodelet)
"""
    (facts,) = units(a_cpp=text)
    assert facts.kind == "nodelet"
    assert [(str(one.name), [site.line for site in one.sites]) for one in facts.endpoints] == [("~/a", [7]), ("b", [])]


def test_rospy(units):
    text = """
import rospy
from std_msgs.msg import String
from std_srvs.srv import Empty
rospy.init_node('n', anonymous=True)
rospy.Publisher('a', String, queue_size=3, latch=True)
rospy.Subscriber('b', String, lambda m: None, queue_size=2)
rospy.Service('c', Empty, print)
rospy.ServiceProxy('d', Empty)
rospy.wait_for_message('e', String)
rospy.Timer(rospy.Duration(0.5), print)
rospy.Publisher(rospy.get_param('~t', 'x'), String, queue_size=1)
"""
    (facts,) = units(a_py=text)
    assert [(e.role.value, str(e.name), e.type.known, e.queue) for e in facts.endpoints] == [
        ("publisher", "a", "std_msgs/String", 3),
        ("subscription", "b", "std_msgs/String", 2),
        ("service_server", "c", "std_srvs/Empty", -1),
        ("service_client", "d", "std_srvs/Empty", -1),
        ("subscription", "e", "std_msgs/String", -1),
        ("publisher", "{parameter ~t}", "std_msgs/String", 1),
    ]
    assert [one.period_s for one in facts.timers] == [0.5]


@pytest.mark.parametrize(
    ("body", "expected"),
    [
        (
            'auto ops = ros::SubscribeOptions::create<std_msgs::String>("in", 5, heard, x, &q); nh.subscribe(ops);',
            ("subscription", "in", "std_msgs/String", 5, False),
        ),
        (
            'ros::SubscribeOptions ops; ops.init<std_msgs::String>("a", 5, heard); ops.topic="b"; nh.subscribe(ops);',
            ("subscription", "b", "std_msgs/String", 5, False),
        ),
        (
            'ros::AdvertiseOptions ops; ops.init<std_msgs::String>("out", 5); ops.latch = true; nh.advertise(ops);',
            ("publisher", "out", "std_msgs/String", 5, True),
        ),
        (
            'nh.advertiseService(ros::AdvertiseServiceOptions::create<std_srvs::Empty>("ask", heard, x, &q));',
            ("service_server", "ask", "std_srvs/Empty", -1, False),
        ),
    ],
)
def test_endpoints_by_options(main_of, body, expected):
    before = "#include <std_srvs/Empty.h>\nvoid heard(const std_msgs::String::ConstPtr & msg) {}"
    (one,) = main_of(body, before).endpoints
    assert (one.role.value, str(one.name), str(one.type), one.queue, one.latched) == expected


def test_a_service_that_is_called_by_its_name(main_of):
    body = (
        'std_srvs::Empty::Request req; std_srvs::Empty::Response res; while (!ros::service::call("ask", req, res)) {}'
    )
    (one,) = main_of(body, "#include <std_srvs/Empty.h>").endpoints
    assert (one.role.value, str(one.name), str(one.type)) == ("service_client", "ask", "std_srvs/Empty")


def test_a_key_that_is_looked_for_is_not_known(main_of):
    body = (
        'std::string key, topic; if (!nh.searchParam("of", key)) { key = "of"; }\n'
        'nh.param(key, topic, std::string("in")); nh.advertise<std_msgs::String>(topic, 1);'
    )
    (one,) = main_of(body).endpoints
    assert (one.name.usual, one.evidence.sure.value) == ("in", "likely")
    assert "the key at which of is found" in str(one.name)


def test_who_gives_a_handle_knows_its_namespace(units):
    text = (
        "#include <ros/ros.h>\n#include <std_msgs/String.h>\n"
        "class A { public: A(const ros::NodeHandle & nh) : nh_(nh) {"
        ' pub_ = nh_.advertise<std_msgs::String>("out", 1); }\n ros::NodeHandle nh_; ros::Publisher pub_; };'
    )
    ((one,),) = (facts.endpoints for facts in units(a_cpp=text))
    assert (one.name.pattern, one.evidence.sure.value) == ("*/out", "possible")


def test_callbacks_of_a_publisher_tell_no_type(main_of):
    before = "void joined(const ros::SingleSubscriberPublisher & p) {}\n"
    body = 'ros::AdvertiseOptions o("a", 1, sum, type, text, joined); auto p = nh.advertise(o);'
    assert [(str(one.name), one.type.known) for one in main_of(body, before).endpoints] == [("a", None)]


def test_what_is_subscribed_to_only_while_somebody_listens(main_of):
    lazy = """
class Lazy {
  ros::NodeHandle nh_; ros::Publisher pub_; ros::Subscriber sub_;
public:
  Lazy() {
    ros::SubscriberStatusCallback visit = boost::bind(&Lazy::visited, this);
    pub_ = nh_.advertise<std_msgs::String>("out", 1, visit, visit);
  }
  void visited() {
    if (pub_.getNumSubscribers() == 0) { sub_.shutdown(); }
    else if (!sub_) { sub_ = nh_.subscribe("in", 1, &Lazy::heard, this); }
  }
  void heard(const std_msgs::StringConstPtr & message) { pub_.publish(message); }
};
"""
    facts = main_of("Lazy lazy;", lazy)
    assert [(one.name.known, one.type.known) for one in facts.endpoints] == [
        ("out", "std_msgs/String"),
        ("in", "std_msgs/String"),
    ]
    assert as_written(facts.endpoints[1].conditions)[0] == "a subscriber connects"


@pytest.mark.parametrize("given", ["boost::bind(&B::x, this, _1)", "std::bind(&B::x, this)", "[this](const M & m) {}"])
def test_what_is_given_a_function_first_is_no_subscription_of_ros(main_of, given):
    assert not main_of(f"lib::Gps gps; gps.subscribe<M>({given}, 1);").endpoints
