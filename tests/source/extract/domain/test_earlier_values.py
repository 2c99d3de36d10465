import pytest

ADVERTISED = "auto p = nh.advertise<std_msgs::String>({}, 1);"


ADVERTISED_T = ADVERTISED.format("t")


def told(main_of, before, after=ADVERTISED_T):
    """Return the name with its default, how sure it is and the parameter that decides it."""
    (one,) = main_of(f"{before}\n{after}").endpoints
    return one.name.usual, one.evidence.sure.value, {hole.parameter for hole in one.name.holes}


@pytest.mark.parametrize(
    "read",
    [
        'nh.getParam("t", t);',
        'ros::param::get("t", t);',
        'nh.getParamCached("t", t);',
        'if (!nh.getParam("t", t)) ROS_WARN("no t");',
        'bool found = nh.getParam("t", t);',
    ],
)
def test_a_variable_keeps_its_value_where_the_parameter_is_not_set(main_of, read):
    assert told(main_of, f'std::string t = "x"; {read}') == ("x", "likely", {"t"})


def test_a_number_is_kept_too(main_of):
    assert told(main_of, 'int n = 3; nh.getParam("n", n);', ADVERTISED.format('"cam" + std::to_string(n)'))[0] == "cam3"


def test_a_member_keeps_what_the_constructor_gave_it(units):
    text = """
#include <ros/ros.h>
#include <std_msgs/String.h>
class A { public: A() : t_("x") { nh_.getParam("t", t_); p_ = nh_.advertise<std_msgs::String>(t_, 1); }
  ros::NodeHandle nh_; ros::Publisher p_; std::string t_; };
int main(int argc, char ** argv) { ros::init(argc, argv, "a"); A a; ros::spin(); }
"""
    (one,) = units(a_cpp=text)[0].endpoints
    assert one.name.usual == "x"


@pytest.mark.parametrize(
    "read",
    [
        'std::string t; nh.getParam("t", t);',
        'std::string t = ""; nh.getParam("t", t);',
        'std::string t = argv[1]; nh.getParam("t", t);',
        'std::string t = argc > 1 ? "x" : "y"; nh.getParam("t", t);',
        'std::string t = "x"; nh.getParam("u", t); nh.getParam("t", t);',
    ],
)
def test_a_value_before_that_is_not_known_says_nothing(main_of, read):
    assert told(main_of, read)[:2] == (None, "possible")


def test_a_default_that_is_given_holds_rather_than_the_value_before(main_of):
    assert told(main_of, 'std::string t = "x"; nh.param<std::string>("t", t, "y");')[0] == "y"


@pytest.mark.parametrize(
    "read",
    [
        'if (!nh.getParam("t", t)) { ROS_ERROR("no t"); return 1; }',
        'if (!nh.getParam("t", t)) return 0;',
        'bool found = nh.getParam("t", t); if (!found) { return -1; }',
        'if (nh.getParam("t", t)) { ROS_INFO("t"); } else { return 1; }',
        'std::string u = "y"; if (!nh.getParam("t", t) || !nh.getParam("u", u)) { return 1; }',
    ],
)
def test_what_follows_where_the_parameter_is_set_alone_has_no_default(main_of, read):
    assert told(main_of, f'std::string t = "x"; {read}')[:2] == (None, "possible")


def test_what_is_made_under_the_condition_that_it_is_set_has_no_default(main_of):
    inside = f'if (nh.getParam("t", t)) {{ {ADVERTISED_T} }}'
    assert told(main_of, 'std::string t = "x";', inside)[:2] == (None, "possible")
    inside = f'if (!nh.getParam("t", t)) {{ {ADVERTISED_T} }}'
    assert told(main_of, 'std::string t = "x";', inside)[0] == "x"


def test_a_parameter_of_ros2_that_is_declared_has_its_default_where_it_is_set(node_of):
    facts = node_of(
        'declare_parameter("t", "x"); std::string t; if (!get_parameter("t", t)) { return; }\n'
        "auto p = create_publisher<std_msgs::msg::String>(t, 1);"
    )
    assert facts.endpoints[0].name.usual == "x"
