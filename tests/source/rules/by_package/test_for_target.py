"""How sure a row of the tables is depends on who says what a package is built for."""

import pytest

from roslens.model.source import Language
from roslens.source.parsed_file import parse_file
from roslens.source.rules.match_file import match_file
from roslens.source.rules.package_findings import rule_findings
from roslens.source.settings import MacroSettings, RuleSettings

MANIFEST = """<package format="3"><name>arm</name><depend>{}</depend>
<export><build_type>ament_cmake</build_type></export></package>"""
SOURCE = b"#include <rclcpp/rclcpp.hpp>\n#include <cv_bridge/cv_bridge.h>\n"


@pytest.fixture
def findings(tmp_path, package_view):
    """What is found of an include in a package for a distribution."""

    def look(container="", distro="", depends="rclcpp"):
        (tmp_path / "arm.cpp").write_bytes(SOURCE)
        (tmp_path / "package.xml").write_text(MANIFEST.format(depends))
        if container:
            (tmp_path / "Dockerfile").write_text(f"FROM ros:{container}\n")
        hits = match_file(parse_file(SOURCE, Language.CPP, MacroSettings()).view()).hits
        settings = RuleSettings(profiles=(), enable=("distribution.header",))
        return rule_findings(package_view(tmp_path, distro=distro), settings, {"arm.cpp": hits}, (), (), [])

    return look


def severities(found):
    return [one.severity.value for one in found]


def test_what_the_named_target_has_not_is_an_error(findings):
    (one,) = findings(distro="jazzy")
    assert one.severity.value == "error"
    assert one.message == (
        "`cv_bridge/cv_bridge.h` is deprecated since Iron and removed in Jazzy; expected `cv_bridge/cv_bridge.hpp`; "
        "this package is built for Jazzy, as `distro` says"
    )
    assert [edit.text for edit in one.edits] == ["cv_bridge/cv_bridge.hpp"]


def test_what_the_guessed_target_has_not_is_a_warning(findings):
    (one,) = findings(container="jazzy")
    assert one.severity.value == "warning"
    assert one.message.endswith("this package is built for Jazzy, as Dockerfile says")


def test_what_the_rule_doubts_itself_is_a_note_whatever_the_target(tmp_path, package_view):
    (tmp_path / "package.xml").write_text(MANIFEST.format("nav2_bringup"))
    text = "recoveries_server:\n  ros__parameters:\n    spin:\n      plugin: nav2_behaviors/Spin\n"
    (tmp_path / "nav.yaml").write_text(text)
    settings = RuleSettings(profiles=(), enable=("distribution.plugin_gone",))
    (one,) = rule_findings(package_view(tmp_path, distro="jazzy"), settings, {}, (), (), [])
    assert one.severity.value == "note"


def test_what_the_target_deprecates_is_a_note(findings):
    assert severities(findings(distro="iron")) == ["note"]


def test_what_the_target_has_is_no_finding(findings):
    assert not findings(distro="humble")


def test_where_no_target_is_known_it_is_a_note_without_a_fix_that_an_old_distribution_lacks(findings):
    (one,) = findings()
    assert one.severity.value == "note"
    assert not one.edits


def test_a_package_for_both_versions_of_ros_may_choose_elsewhere(findings):
    assert severities(findings(distro="jazzy", depends="rclcpp</depend><depend>roscpp")) == ["note"]


def test_what_the_workspace_has_itself_is_there(findings, tmp_path):
    own = tmp_path / "include/cv_bridge/cv_bridge.h"
    own.parent.mkdir(parents=True)
    own.write_text("#pragma once\n")
    assert not findings(distro="jazzy")


def test_what_a_package_beside_it_has_is_there(package_view, tmp_path):
    for name, depends in (("arm", "cv_bridge"), ("cv_bridge", "rclcpp")):
        (tmp_path / name).mkdir()
        (tmp_path / name / "package.xml").write_text(MANIFEST.format(depends).replace("<name>arm", f"<name>{name}"))
    (tmp_path / "arm/arm.cpp").write_bytes(SOURCE)
    hits = match_file(parse_file(SOURCE, Language.CPP, MacroSettings()).view()).hits
    settings = RuleSettings(profiles=(), enable=("distribution.header",))
    view = package_view(tmp_path, "arm", "jazzy")
    assert not rule_findings(view, settings, {"arm/arm.cpp": hits}, (), (), [])
