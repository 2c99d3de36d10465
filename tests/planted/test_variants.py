"""Variants of an example: twenty texts, none of which is another one's, and all of which can be read."""

import ast

import pytest

from planted.measuring import default_rules
from planted.variants import VARIANTS, renamed, split, variant
from roslens.source.rules.rule import FileRule

RULES = [rule for rule in default_rules() if isinstance(rule, FileRule)]
CPP = """#include <rclcpp/rclcpp.hpp>
void Arm::tick() { if (client_->wait_for_service(5s)) { ask("Arm", nh_); } }
void Arm::start() { timer_ = create_wall_timer(1s, std::bind(&Arm::tick, this)); }
"""


def test_names_change_everywhere_but_in_texts():
    text = renamed(CPP, "cpp", 1)
    assert "Arm::" not in text
    assert '"Arm"' in text
    assert text.count("front_timer_") == 1
    assert text.count("front_client_") == 1
    assert text.count("front_nh_") == 1
    assert "create_wall_timer" in text
    assert "wait_for_service" in text


def test_what_is_imported_or_called_keeps_its_name():
    text = "import rospy\ndef on_scan(scan):\n    pass\ndef run():\n    rospy.Subscriber('scan', Scan, run)\n"
    changed = renamed(text, "python", 1)
    assert "rospy.Subscriber('scan', Scan, front_run)" in changed
    assert "def on_scan" in changed


def test_includes_are_taken_from_the_beginning():
    assert split("#include <a>\n#include <b>\nint a;\n") == ("#include <a>\n#include <b>\n", "int a;\n")


@pytest.mark.parametrize("syntax", ["cpp", "python"])
def test_variants_differ(syntax):
    text = next(rule.bad for rule in RULES if rule.syntax == syntax and rule.id.startswith("node."))
    assert len({variant(text, syntax, number) for number in range(VARIANTS)}) >= VARIANTS / 2


def test_variants_of_python_can_be_parsed_where_the_example_can():
    for rule in RULES:
        if rule.syntax != "python":
            continue
        try:
            ast.parse(rule.bad)
        except SyntaxError:
            continue
        for number in range(5):
            ast.parse(variant(rule.bad, "python", number, rule.id))
