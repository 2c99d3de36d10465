"""A robot of several roots: refused for sure where it has joints, and perhaps only begun where it has none."""

import pytest

from roslens.model.weight.consequence import Certainty
from roslens.source.rules.package.configuration.robot_tree import found

MANIFEST = "<package format='3'><name>p</name><export><build_type>ament_cmake</build_type></export></package>"
JOINT = "<joint name='j' type='fixed'><parent link='base'/><child link='arm'/></joint><link name='arm'/>"


@pytest.mark.parametrize(("more", "certainty"), [("", Certainty.HEURISTIC), (JOINT, None)])
def test_without_any_joint_it_is_a_note(more, certainty, package_view, tmp_path):
    (tmp_path / "package.xml").write_text(MANIFEST)
    (tmp_path / "wheel.xacro").write_text(
        "<robot xmlns:xacro='http://www.ros.org/wiki/xacro'><link name='wheel'/></robot>"
    )
    (tmp_path / "rover.urdf.xacro").write_text(
        "<robot name='r' xmlns:xacro='http://www.ros.org/wiki/xacro'>"
        f"<xacro:include filename='$(find p)/wheel.xacro'/><link name='base'/>{more}</robot>"
    )
    (hit,) = found(package_view(tmp_path))
    assert hit.certainty is certainty
