"""The package that makes roslens a test: catkin builds it, runs it for another one, and reads what it found."""

import os
import shutil
import subprocess
from pathlib import Path
from xml.etree.ElementTree import parse

import pytest

ROOT = Path(__file__).parents[2]
LISTS = """\
cmake_minimum_required(VERSION 3.10)
project(rover C)
find_package(catkin REQUIRED)
catkin_package()
include({extras})
catkin_add_roslens_test(FAIL_ON note ARGUMENTS --model his)
"""
MANIFEST = """\
<package format="2"><name>rover</name><version>1.0.0</version><description>d</description>
<maintainer email="a@example.org">a</maintainer><license>MIT</license>
<buildtool_depend>catkin</buildtool_depend></package>
"""
CALLS = "def walk(step):\n" + "".join(f"    step.move_{number}()\n" for number in range(40))


@pytest.mark.real
def test_catkin_runs_it(tmp_path):
    for part in ("cmake", "catkin_make", "catkin_test_results"):
        if not shutil.which(part):
            pytest.skip(f"{part} is not installed")
    source, build = tmp_path / "rover", tmp_path / "build"
    source.mkdir()
    extras = ROOT / "ros/ament_cmake_roslens/cmake/catkin_add_roslens_test.cmake"
    (source / "CMakeLists.txt").write_text(LISTS.format(extras=extras))
    (source / "package.xml").write_text(MANIFEST)
    (source / "walking.py").write_text(CALLS)
    environment = {name: value for name, value in os.environ.items() if name not in {"PYTHONPATH", "MAKEFLAGS"}}
    environment["PATH"] = f"/usr/bin:/bin:{ROOT / '.venv/bin'}"
    words = ["-DPYTHON_EXECUTABLE=/usr/bin/python3", f"-DCATKIN_DEVEL_PREFIX={tmp_path / 'devel'}"]
    for command in (
        ["cmake", "-S", str(source), "-B", str(build), *words],
        ["cmake", "--build", str(build), "--target", "run_tests"],
    ):
        done = subprocess.run(command, env=environment, capture_output=True, text=True, check=False)
        assert not done.returncode, done.stdout + done.stderr
    (result,) = build.rglob("roslens-rover.xml")
    assert parse(result).getroot().find("testsuite").get("name") == "roslens.rover"
    reported = subprocess.run(
        ["catkin_test_results", str(build)], capture_output=True, text=True, check=False, env=environment
    )
    assert reported.returncode == 1
    assert "roslens-rover.xml" in reported.stdout
    assert not (source / ".roslens").exists()


@pytest.mark.real
def test_catkin_builds_the_package(tmp_path):
    if not shutil.which("cmake") or not shutil.which("catkin_make"):
        pytest.skip("catkin is not installed")
    environment = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}
    words = ["-DPYTHON_EXECUTABLE=/usr/bin/python3", f"-DCATKIN_DEVEL_PREFIX={tmp_path / 'devel'}"]
    command = ["cmake", "-S", str(ROOT / "ros/ament_cmake_roslens"), "-B", str(tmp_path / "build"), *words]
    done = subprocess.run(command, env={**environment, "ROS_VERSION": "1"}, capture_output=True, text=True, check=False)
    assert not done.returncode, done.stdout + done.stderr
    config = tmp_path / "devel/share/ament_cmake_roslens/cmake/ament_cmake_roslensConfig.cmake"
    assert "catkin_add_roslens_test.cmake" in config.read_text()
