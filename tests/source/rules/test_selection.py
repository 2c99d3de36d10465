"""Which native rules are on."""

import msgspec
import pytest

from roslens.model.errors import UsageError
from roslens.model.finding import Severity
from roslens.model.source import Dependency, Location, Package
from roslens.source.rules.profiles import profiles_of
from roslens.source.rules.selection import check_rule_settings, selected, wanted_rules
from roslens.source.rules.table import native_rules
from roslens.source.settings import RuleSettings

RULES = native_rules()
PLACE = Location("package.xml")


def package(build_type="ament_cmake", *needs):
    return Package(
        "a",
        "a",
        ".",
        PLACE,
        build_type=build_type,
        dependencies=tuple(Dependency(one, "depend", PLACE) for one in needs),
    )


@pytest.mark.parametrize(
    ("one", "profiles"),
    [
        (package(), ("ros2",)),
        (package("catkin", "roscpp"), ("ros1",)),
        (package("cmake"), ("ros2",)),
        (package("ament_cmake", "rclcpp", "roscpp"), ("ros2", "ros1")),
    ],
)
def test_a_package_is_held_against_the_rules_of_its_ros(one, profiles):
    assert profiles_of(one) == profiles


def test_profiles_then_what_is_turned_on_and_off():
    on = selected(RuleSettings(("misra-cpp-2008",), ("node.console_output",), ("cpp.goto",)), package(), RULES)
    assert "node.console_output" in on
    assert "cpp.goto" not in on
    assert all("misra-cpp-2008" in RULES[one].profiles for one in on if one != "node.console_output")
    assert "cpp.goto" in selected(RuleSettings((), ("cpp.*",)), package(), RULES)


def test_a_severity_of_the_users():
    settings = RuleSettings(severity={"node.console_output": "error"})
    assert selected(settings, package(), RULES)["node.console_output"] is Severity.ERROR


@pytest.mark.parametrize(
    "settings", [RuleSettings(), RuleSettings(("google",), ("cpp.goto",)), RuleSettings(("auto",), disable=("node.*",))]
)
def test_files_are_held_against_all_that_any_package_may_want_and_nothing_else(settings):
    kinds = (package(), package("catkin", "roscpp"), package("ament_cmake", "rclcpp", "roscpp"))
    anyone = {one for kind in kinds for one in selected(settings, kind, RULES)}
    assert wanted_rules(settings, RULES) == anyone


@pytest.mark.parametrize(
    ("settings", "what", "advice"),
    [
        (RuleSettings(("misra",)), "profile 'misra' is unknown", ""),
        (RuleSettings(disable=("cpp.gotoo",)), "rule 'cpp.gotoo' is unknown", "cpp.goto"),
        (RuleSettings(severity={"cpp.goto": "fatal"}), "severity 'fatal' of rule 'cpp.goto' is unknown", ""),
    ],
)
def test_what_means_nothing_is_refused_with_advice(settings, what, advice):
    with pytest.raises(UsageError, match=what) as raised:
        check_rule_settings(settings, RULES)
    assert advice in str(raised.value)


def test_two_rules_that_require_opposites_cannot_both_be_on():
    opposed = msgspec.structs.replace(RULES["cpp.goto"], unlike=("node.console_output",))
    rules = {**RULES, opposed.id: opposed}
    with pytest.raises(UsageError, match="opposite of each other"):
        check_rule_settings(RuleSettings((), ("cpp.goto", "node.console_output")), rules)
    check_rule_settings(RuleSettings((), ("cpp.goto", "node.console_output"), ("cpp.goto",)), rules)
