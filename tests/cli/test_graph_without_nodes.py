"""What is said where there are no nodes."""

import pytest

from roslens.cli.main import main

PACKAGE = """<package format="3"><name>p</name><version>1.0.0</version><description>d</description>
<maintainer email="a@example.org">a</maintainer><license>MIT</license>
<export><build_type>ament_python</build_type></export></package>"""
SETUP = """from setuptools import setup
setup(name="p", packages=["p"], entry_points={"console_scripts": ["talk = p.talk:main"]})
"""
TALK = """import rclpy
def main():
    rclpy.init()
    rclpy.spin(rclpy.create_node("talk"))
"""
LAUNCH = """from launch import LaunchDescription
from launch_ros.actions import Node
def generate_launch_description():
    return LaunchDescription([Node(package="other", executable="other")])
"""


@pytest.fixture
def workspace(tmp_path):
    (tmp_path / "p" / "p").mkdir(parents=True)
    (tmp_path / "p" / "package.xml").write_text(PACKAGE)
    return tmp_path


def test_programs_that_are_not_found_are_told(workspace, capsys):
    (workspace / "p" / "setup.py").write_text(SETUP)
    (workspace / "p" / "p" / "talk.py").write_text(TALK)
    assert main(["graph", str(workspace)]) == 3
    reported = capsys.readouterr()
    assert reported.out == "no nodes\n"
    assert "p/setup.py:2: talk is not installed to lib/p: ros2 run and launch files look there" in reported.err
    (workspace / "p" / "setup.cfg").write_text("[install]\ninstall_scripts=$base/lib/p\n")
    assert main(["graph", str(workspace)]) == 0
    assert "lib/p" not in capsys.readouterr().err


def test_launch_files_that_start_nodes_of_others_are_told(workspace, capsys):
    (workspace / "p" / "launch").mkdir()
    for name in ("a", "b"):
        (workspace / "p" / "launch" / f"{name}.launch.py").write_text(LAUNCH)
    assert main(["graph", str(workspace)]) == 3
    assert "try --launch p/launch/a.launch.py, or one of 1 more" in capsys.readouterr().err
    assert main(["graph", "-q", str(workspace)]) == 3
    assert capsys.readouterr().err == ""


def test_a_folder_without_packages_is_told(tmp_path, capsys):
    assert main(["graph", str(tmp_path)]) != 0
    assert "package" in capsys.readouterr().err
