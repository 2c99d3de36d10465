"""What Python 3 cannot do is a mistake in packages that something says to be for it."""

import pytest

from roslens.model.source import OUTSIDE_PACKAGES, Location, Package
from roslens.model.weight.consequence import Certainty
from roslens.source.rules.by_package.python2_package import as_notes_without_python3
from roslens.source.rules.hit import Hit
from roslens.source.rules.package_view import PackageView

ROS1 = "<package format='{}'><name>p</name><buildtool_depend>catkin</buildtool_depend>{}</package>"
ROS2 = "<package format='3'><name>p</name><export><build_type>ament_python</build_type></export></package>"


@pytest.mark.parametrize(
    ("manifest", "first", "is_note"),
    [
        (ROS1.format(2, ""), "#!/usr/bin/env python", True),
        (ROS1.format(2, "<depend>python-yaml</depend>"), "import rospy", True),
        (ROS1.format(2, "<depend>python3-yaml</depend>"), "import rospy", False),
        (ROS1.format(2, ""), "#!/usr/bin/env python3", False),
        (ROS1.format(3, ""), "#!/usr/bin/env python", False),
        (ROS2, "import rclpy", False),
    ],
)
def test_a_package_that_nothing_says_to_be_for_python_3_has_notes(manifest, first, is_note, package_view, tmp_path):
    (tmp_path / "package.xml").write_text(manifest)
    (tmp_path / "a.py").write_text(f"{first}\n")
    placed = {"a.py": [Hit("python.python2_syntax", "m", 1), Hit("python.bare_except", "m", 2)]}
    ((first, second),) = as_notes_without_python3(placed, package_view(tmp_path)).values()
    assert (first.certainty is Certainty.HEURISTIC) is is_note
    assert second.certainty is None


def test_what_lies_outside_of_packages_has_notes(tmp_path):
    (tmp_path / "a.py").write_text("print 1\n")
    package = Package(OUTSIDE_PACKAGES, OUTSIDE_PACKAGES, ".", Location(""))
    placed = {"a.py": [Hit("python.python2_syntax", "m", 1)]}
    ((only,),) = as_notes_without_python3(placed, PackageView(package, str(tmp_path), (), {}, others=())).values()
    assert only.certainty is Certainty.HEURISTIC
