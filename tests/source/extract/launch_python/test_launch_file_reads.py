"""Files of the workspace that launch files in Python read."""

import pytest

from roslens.source.extract.launch.launch_ros2 import evaluate_ros2

CODE = """
import os, yaml
from ament_index_python.packages import get_package_share_directory
from launch import LaunchDescription
from launch_ros.actions import Node
def generate_launch_description():
    config = os.path.join(get_package_share_directory('robot'), 'config', '{name}')
{load}
    return LaunchDescription([Node(package='p', executable='e', parameters=[params])])
"""
YAML = "node:\n  ros__parameters:\n    rate: 10\n    frame: base\n    nested:\n      deep: true\n    list: [1, 2]\n"


class Files:
    """A package with a file of parameters."""

    def package(self, name):
        return "robot" if name == "robot" else None

    def content(self, path):
        return self._found.get(path)

    def __init__(self, text):
        self._found = {
            "robot/launch/a.launch.py": text.encode(),
            "robot/config/a.yaml": YAML.encode(),
            "robot/config/bad.yaml": b"a: [",
            "robot/config/binary.yaml": b"\xff\xfe\x00\x01\x80",
        }


def launched(load, name="a.yaml"):
    return evaluate_ros2("robot/launch/a.launch.py", Files(CODE.format(load=load, name=name)))


@pytest.mark.parametrize(
    "load",
    [
        "    with open(config, 'r') as f:\n        params = yaml.safe_load(f)['node']['ros__parameters']",
        "    params = yaml.safe_load(open(config))['node']['ros__parameters']",
        "    params = yaml.load(open(config).read(), Loader=yaml.SafeLoader)['node']['ros__parameters']",
    ],
)
def test_parameters_of_a_file(load):
    found = launched(load)
    assert found.unresolved == ()
    settings = {str(one.name): str(one.value) for one in found.nodes[0].settings}
    assert {name: settings[name] for name in ("rate", "frame", "nested.deep")} == {
        "rate": "10", "frame": "base", "nested.deep": "True",
    }  # fmt: skip


@pytest.mark.parametrize("name", ["bad.yaml", "binary.yaml", "missing.yaml"])
def test_a_file_that_cannot_be_read_is_said(name):
    found = launched("    params = yaml.safe_load(open(config))", name)
    assert [one.evidence.path for one in found.unresolved] == ["robot/launch/a.launch.py"]
