"""What a header tells of members, for rules on the sources that use them."""

from roslens.model.source import Language
from roslens.source.parsed_file import parse_file
from roslens.source.rules.callbacks import callbacks_of
from roslens.source.rules.cpp_flow.member_facts import member_facts
from roslens.source.rules.match_file import match_file
from roslens.source.rules.place_hits import place_hits
from roslens.source.rules.table import native_rules
from roslens.source.settings import MacroSettings

HEADER = """
#pragma once
#include <rclcpp/rclcpp.hpp>
namespace rover {
class Arm : public rclcpp_lifecycle::LifecycleNode {
  struct Inner { bool inner_; };
  void move(double by);
  double limit_{0.5}, least_;
  uint8_t count_ = 3;
  std::string frame_;
  rclcpp::Duration period_;
  rclcpp_lifecycle::LifecyclePublisher<std_msgs::msg::Float64>::SharedPtr level_;
  rclcpp::Publisher<std_msgs::msg::Float64>::SharedPtr plain_;
};
}
"""
SOURCE = """
#include "arm.hpp"
#include <rclcpp/rclcpp.hpp>
Arm::Arm() : LifecycleNode("arm") {
  declare_parameter("limit", 5);
  get_parameter("limit", {into});
  level_ = create_publisher<std_msgs::msg::Float64>("level", 10);
  plain_ = create_publisher<std_msgs::msg::Float64>("plain", 10);
}
Return Arm::on_activate(const State &) { {used}->publish(msg_); return Return::SUCCESS; }
"""


def view_of(text):
    return parse_file(text.encode(), Language.CPP, MacroSettings()).view()


def found(source, rule):
    view, rules = view_of(source), native_rules()
    told = (*callbacks_of(view), *member_facts(view), *member_facts(view_of(HEADER)))
    placed = place_hits({"arm.cpp": match_file(view).hits}, told, {rule: rules[rule].severity}, rules, ())
    return [one.message for one in placed]


def test_members_are_told_with_their_class_and_kind():
    assert member_facts(view_of(HEADER)) == (
        "member Arm::count_ int",
        "member Arm::frame_ string",
        "member Arm::least_ double",
        "member Arm::level_ LifecyclePublisher",
        "member Arm::limit_ double",
        "member Arm::period_ Duration",
        "member Inner::inner_ bool",
    )


def test_a_source_tells_nothing():
    assert member_facts(view_of(HEADER.replace("#pragma once", ""))) == ()


def test_a_duration_that_a_header_declares_is_made_of_a_number():
    rule = "node.nanosecond_duration"
    source = SOURCE.replace("{into}", "count_").replace('LifecycleNode("arm")', 'LifecycleNode("arm"), {made}(5)')
    assert "takes 5 as nanoseconds" in found(source.replace("{made}", "period_"), rule)[0]
    assert found(source.replace("{made}", "count_"), rule) == []


def test_a_file_without_rclcpp_tells_nothing():
    assert member_facts(view_of("#pragma once\nclass Arm { double limit_; };")) == ()


def test_a_parameter_is_read_into_a_member_of_another_type():
    rule = "node.parameter_read_as"
    assert "declared as int (line 5) and read as double" in found(SOURCE.replace("{into}", "limit_"), rule)[0]
    assert found(SOURCE.replace("{into}", "count_"), rule) == []
    assert found(SOURCE.replace("{into}", "unknown_"), rule) == []


def test_only_a_lifecycle_publisher_has_to_be_activated():
    rule = "node.lifecycle_publisher_inactive"
    assert "`level_` (line 7)" in found(SOURCE.replace("{used}", "level_"), rule)[0]
    assert found(SOURCE.replace("{used}", "plain_"), rule) == []
