"""What is wrong and harms nobody as things stand is a note: where it is switched off, left behind, or made up for."""

import pytest

from roslens.model.finding import Severity
from roslens.source.rules.package_findings import rule_findings
from roslens.source.settings import RuleSettings

MANIFEST = (
    "<package format='3'><name>p</name><depend>pluginlib</depend><export><build_type>{}</build_type></export></package>"
)
PLUGINS = '<library path="a"><class type="arm::{}" base_class_type="base::Base"/></library>'
SOURCE = (
    "namespace arm {{}}\nPLUGINLIB_EXPORT_CLASS(arm::Driver, base::Base)\n"
    "{}PLUGINLIB_EXPORT_CLASS(arm::{}, base::Base)\n"
)
USES = '<launch><param name="a" value="$(arg arm)"/></launch>'
INCLUDES = '<launch><include file="$(find p)/launch/a.launch"/></launch>'
SHOWS = '<launch><node name="a" pkg="rviz" type="rviz" args="-d $(find p)/{}"/></launch>'


@pytest.mark.parametrize(
    ("rule", "kind", "files", "severity"),
    [
        (
            "package.plugin_class",
            "ament_cmake",
            {"plugins.xml": PLUGINS.format("Spare"), "src/a.cpp": SOURCE.format("// ", "Spare")},
            Severity.NOTE,
        ),
        (
            "package.plugin_class",
            "ament_cmake",
            {"plugins.xml": PLUGINS.format("Spare"), "src/a.cpp": SOURCE.format("// ", "Other")},
            Severity.WARNING,
        ),
        ("launch.undeclared_argument", "catkin", {"launch/legacy/a.launch": USES}, Severity.NOTE),
        ("launch.undeclared_argument", "catkin", {"launch/a.launch": USES}, Severity.NOTE),
        (
            "launch.undeclared_argument",
            "catkin",
            {"launch/a.launch": USES, "launch/all.launch": INCLUDES},
            Severity.WARNING,
        ),
        ("launch.missing_file", "catkin", {"launch/a.launch": SHOWS.format("urdf.rviz")}, Severity.NOTE),
        ("launch.missing_file", "catkin", {"launch/a.launch": SHOWS.format("urdf.yaml")}, Severity.WARNING),
    ],
)
def test_severity(rule, kind, files, severity, package_view, tmp_path):
    build = "cmake_minimum_required(VERSION 3.8)\nproject(p)\nadd_library(a SHARED src/a.cpp)\n"
    for path, text in {"package.xml": MANIFEST.format(kind), "CMakeLists.txt": build, **files}.items():
        (tmp_path / "p" / path).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / "p" / path).write_text(text)
    failures = []
    found = rule_findings(package_view(tmp_path, "p"), RuleSettings((), (rule,)), {}, (), (), failures)
    assert not failures
    assert [one.severity for one in found if "Driver" not in one.message] == [severity]
