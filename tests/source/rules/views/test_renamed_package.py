"""What rules say where launch files name a package that has another name now."""

import pytest

from roslens.source.rules.package_findings import rule_findings
from roslens.source.settings import RuleSettings

MANIFEST = "<package format='3'><name>{}</name>{}<export><build_type>ament_cmake</build_type></export></package>"
START = '<launch><include file="$(find-pkg-share {})/launch/all.launch.xml"/></launch>'


def package(folder, name, asks="", **files):
    (folder / name / "launch").mkdir(parents=True)
    (folder / name / "package.xml").write_text(MANIFEST.format(name, asks))
    (folder / name / "CMakeLists.txt").write_text("find_package(ament_cmake REQUIRED)\nament_package()\n")
    for stem, text in files.items():
        (folder / name / "launch" / f"{stem}.launch.xml").write_text(text)


def found(rule, view):
    failures = []
    findings = rule_findings(view, RuleSettings((), (rule,)), {}, (), (), failures)
    assert not failures
    return [one.message for one in findings]


@pytest.mark.parametrize(
    ("named", "asked"),
    [("arm_serial_driver", True), ("arm_serial_msgs", False), ("wheel_odometry_driver", False), ("arm_can_driver", 0)],
)
def test_a_name_that_the_workspace_almost_has_is_asked_for(named, asked, package_view, tmp_path):
    package(tmp_path, "arm_bringup", start=START.format(named))
    package(tmp_path, "arm_can_driver")
    (message,) = found("package.undeclared_dependency", package_view(tmp_path, "arm_bringup"))
    assert message.endswith(
        f"; the workspace has 'arm_can_driver' and no {named!r}: is that its name now?" if asked else "<exec_depend>"
    )


@pytest.mark.parametrize(
    ("files", "number"),
    [
        ({"old": START.format("arm_serial_driver")}, 0),
        ({"old": START.format("arm_serial_driver"), "new": START.format("arm_can_driver")}, 1),
        ({"new": START.format("slam_toolbox")}, 1),
    ],
)
def test_launch_files_that_cannot_start_need_no_installation(files, number, package_view, tmp_path):
    package(tmp_path, "arm_can_driver", **files)
    assert len(found("cmake.folder_not_installed", package_view(tmp_path, "arm_can_driver"))) == number


def test_what_most_files_need_comes_first(package_view, tmp_path):
    lines = (START.format("joy_teleop"), START.format("slam_toolbox"), START.format("slam_toolbox"))
    package(tmp_path, "p", a=lines[0], b=lines[1], c=lines[2])
    (message,) = found("package.undeclared_dependency", package_view(tmp_path, "p"))
    assert "'slam_toolbox', 'joy_teleop' (by launch files)" in message
