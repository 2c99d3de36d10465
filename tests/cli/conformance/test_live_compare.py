"""`roslens compare` of source and a robot that really runs; every day what was recorded of it is compared."""

from __future__ import annotations

import json
import os
from pathlib import Path

import pytest
from accuracy import ros2
from accuracy.processes import Processes
from accuracy.reading import lay_out
from accuracy.system import systems

from roslens.cli.main import main
from roslens.live.adapters.child import clean_environment


@pytest.mark.real
@pytest.mark.nightly
def test_a_robot_of_ros2_lacks_a_node_and_has_another_remapping(tmp_path: Path, monkeypatch, capsys) -> None:
    system = systems()["robot_ros2"]
    if reason := ros2.why_not(system):
        pytest.skip(reason)
    lay_out(system, tmp_path / "ws")
    scripts = tmp_path / "ws/src/robot_ros2/scripts"
    monkeypatch.setenv("ROS_AUTOMATIC_DISCOVERY_RANGE", "LOCALHOST")
    domain = str(ros2.free_domain())
    environment = {**clean_environment(os.environ), "ROS_DOMAIN_ID": domain}
    logs = tmp_path / "logs"
    logs.mkdir()
    with Processes(logs) as processes:
        for name, *words in (
            ("odometry",),
            ("lidar", "-r", "__node:=front_lidar"),
            ("planner", "-r", "__ns:=/rover", "-r", "__node:=planner", "-r", "/scan:=/front/raw"),
        ):
            processes.start([ros2.python(), str(scripts / f"ros2_{name}.py"), "--ros-args", *words], environment)
        words = ["compare", str(tmp_path / "ws"), "live", "--ros2", "--python", ros2.python(), "--domain", domain]
        code = main([*words, "--format", "json", "-q", "--jobs", "1"])
    found = json.loads(capsys.readouterr().out)
    assert code == 1
    rows = [one for one in found["disparities"] if one["severity"] != "note"]
    grave = {(one["kind"], one["node"], one["aspect"], one["reason"]) for one in rows}
    assert ("node", "/rover/camera", "presence", "not_running") in grave
    assert ("subscription", "/rover/planner", "name", "remapped") in grave
    assert found["agreed"]["node"] == 3
