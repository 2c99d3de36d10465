import pytest

from roslens.source.extract.symbolic.condition import as_written


def writes(facts):
    return [
        (str(one.name), one.type, None if one.value is None else str(one.value), one.writer.sure.value)
        for one in facts.parameters
        if one.access == "written"
    ]


@pytest.mark.parametrize(
    ("body", "expected"),
    [
        ('nh.setParam("a", 1);', ("a", "int", "1", "certain")),
        ('nh.setParam("a", 2.0);', ("a", "double", "2.0", "certain")),
        ('nh.setParam("a", true);', ("a", "bool", "true", "certain")),
        ('ros::NodeHandle own("~"); own.setParam("a", std::string("b"));', ("~/a", "string", "b", "certain")),
        ('ros::param::set("/a", "b");', ("/a", "string", "b", "certain")),
        ('nh.setParam("a", argc);', ("a", "", "{argc}", "certain")),
    ],
)
def test_values_that_roscpp_writes(main_of, body, expected):
    assert writes(main_of(body)) == [expected]


def test_what_comes_when_the_node_runs_is_less_sure(main_of):
    before = 'void got(const std_msgs::String &) { ros::NodeHandle nh; nh.setParam("a", 1); }'
    facts = main_of('nh.subscribe("t", 1, got); ros::spin(); nh.setParam("b", 2);', before)
    assert writes(facts) == [("b", "int", "2", "likely"), ("a", "int", "1", "likely")]


def test_values_that_rospy_writes(units):
    text = """
import rospy
rospy.init_node("a")
rospy.set_param("~ready", True)
rospy.set_param("gains", {"p": 1.5, "deep": {"i": 2}})
rospy.set_param(param_name="names", param_value=["a", "b"])
rospy.set_param("none", {})
"""
    (facts,) = units(a_py=text)
    assert writes(facts) == [
        ("~ready", "bool", "true", "certain"),
        ("gains/p", "double", "1.5", "certain"),
        ("gains/deep/i", "int", "2", "certain"),
        ("names", "string_array", "[a, b]", "certain"),
        ("none", "", "{a structured value}", "certain"),
    ]


def test_a_condition_is_kept(main_of):
    (one,) = main_of('if (argc > 1) nh.setParam("a", 1);').parameters
    assert as_written(one.conditions) == ("argc > 1",)
