import os
import subprocess
import sys

from accuracy.installing import install

SETUP = """
from setuptools import setup
setup(
    name="greeter",
    data_files=[("share/greeter/launch", ["launch/a.launch.xml"])],
    entry_points={"console_scripts": ["hello = greeter.hello:main"]},
)
"""


def test_a_package_is_installed_as_its_setup_says(tmp_path):
    package = tmp_path / "src" / "greeter"
    for name, text in {
        "package.xml": "<package><name>greeter</name></package>",
        "setup.py": SETUP,
        "launch/a.launch.xml": "<launch/>",
        "greeter/hello.py": "def main():\n    print('hello')\n",
    }.items():
        path = package / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
    prefix = tmp_path / "install"
    paths = install(tmp_path / "src", prefix, sys.executable)
    assert paths == [package]
    assert (prefix / "share" / "greeter" / "launch" / "a.launch.xml").exists()
    assert (prefix / "share" / "ament_index" / "resource_index" / "packages" / "greeter").exists()
    program = prefix / "lib" / "greeter" / "hello"
    environment = {**os.environ, "PYTHONPATH": str(package)}
    assert subprocess.run([program], env=environment, capture_output=True, check=True).stdout == b"hello\n"


def test_scripts_of_a_package_of_cmake_are_programs(tmp_path):
    package = tmp_path / "src" / "scripted"
    (package / "scripts").mkdir(parents=True)
    (package / "package.xml").write_text("<package><name> scripted </name></package>")
    (package / "scripts" / "one.py").write_text("print('one')\n")
    assert install(tmp_path / "src", tmp_path / "install", sys.executable) == []
    program = tmp_path / "install" / "lib" / "scripted" / "one.py"
    assert subprocess.run([program], capture_output=True, check=True).stdout == b"one\n"
