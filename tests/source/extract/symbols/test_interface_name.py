import pytest

from roslens.source.extract.lowering.cpp.cpp_program import program_of_cpp
from roslens.source.extract.symbols.interface_name import (
    included_interface,
    interface_name,
    lower_interface,
    of_generation,
    used_interface,
)
from roslens.source.syntax.macro.macros import load_macros


@pytest.mark.parametrize(
    ("written", "name"),
    [
        ("std_msgs::String", "std_msgs/String"),
        ("std_msgs::msg::String", "std_msgs/msg/String"),
        ("const std_msgs::String::ConstPtr &", "std_msgs/String"),
        ("std_msgs::StringConstPtr", "std_msgs/String"),
        ("std_msgs::msg::String::SharedPtr", "std_msgs/msg/String"),
        ("const std::shared_ptr<std_srvs::srv::Trigger::Request>", "std_srvs/srv/Trigger"),
        ("std_msgs.msg.String", "std_msgs/msg/String"),
        ("car_msgs.msg.runstop", "car_msgs/msg/runstop"),
        ("car_msgs.runstop", ""),
        ("std_msgs.msg._String.String", "std_msgs/msg/String"),
        ("nav2_msgs::action::Spin::Impl::FeedbackMessage", "nav2_msgs/action/Spin_FeedbackMessage"),
        ("Impl::Message", ""),
        ("p::Feedback", "p/Feedback"),
        ("const p::Goal::ConstPtr &", "p/Goal"),
        ("p::ResultConstPtr", "p/Result"),
        ("p::msg::Request::SharedPtr", "p/msg/Request"),
        ("p.msg.Response", "p/msg/Response"),
        ("p.msg._Feedback.Feedback", "p/msg/Feedback"),
        ("p::Do::Request &", "p/Do"),
        ("p::srv::Do::Response::SharedPtr", "p/srv/Do"),
        ("p::action::Go::Feedback", "p/action/Go"),
        ("MessageT", ""),
        ("", ""),
        ("int", ""),
    ],
)
def test_names_of_types(written, name):
    assert interface_name(written) == name


@pytest.mark.parametrize(
    ("name", "generation", "kind", "form"),
    [
        ("std_msgs/msg/String", "ros1", "msg", "std_msgs/String"),
        ("std_msgs/String", "ros2", "msg", "std_msgs/msg/String"),
        ("std_srvs/Empty", "ros2", "srv", "std_srvs/srv/Empty"),
        ("std_msgs/String", "ros1", "msg", "std_msgs/String"),
    ],
)
def test_the_form_of_a_generation(name, generation, kind, form):
    assert of_generation(name, generation, kind) == form


def test_a_type_by_the_header_that_is_included():
    program = program_of_cpp(b'#include <navfn/MakeNavPlan.h>\n#include "a/b/Other.h"\n', load_macros())
    assert included_interface("MakeNavPlan::Request &", program) == "navfn/MakeNavPlan"
    assert included_interface("Other", program) == ""


def test_a_type_with_a_small_letter_is_one_where_its_header_is_included():
    assert lower_interface("const car_msgs::runstop::ConstPtr&", {"car_msgs/runstop.h"}) == "car_msgs/runstop"
    assert lower_interface("std::string", {"car_msgs/runstop.h"}) == ""
    assert lower_interface("runstop", {"runstop.h"}) == ""


def test_a_type_of_a_namespace_that_is_used_whole():
    headers = {"one_msgs/msg/the_type.hpp", "two_msgs/msg/other2.hpp", "two_msgs/srv/the_type.hpp"}
    using = ("std.chrono", "one_msgs.msg", "two_msgs.msg")
    assert used_interface("TheType", "msg", using, headers) == "one_msgs/msg/TheType"
    assert used_interface("Other2", "msg", using, headers) == "two_msgs/msg/Other2"
    assert used_interface("TheType", "srv", using, headers) == ""
    assert used_interface("TheType", "msg", using, {*headers, "two_msgs/msg/the_type.hpp"}) == ""


@pytest.mark.parametrize(
    "written",
    ["pcl::PointCloud<pcl::PointXYZ>", "const pcl::PointCloud<pcl::PointXYZI>::ConstPtr &", "pcl::PCLPointCloud2"],
)
def test_a_cloud_of_pcl_is_sent_as_the_message(written):
    assert interface_name(written) == "sensor_msgs/PointCloud2"
