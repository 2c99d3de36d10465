import subprocess

import pytest
import yaml

from roslens.live.publish.exported.alertmanager_config import alertmanager_config


def test_what_follows_from_a_first_cause_goes_to_nobody(rover):
    config = yaml.safe_load(alertmanager_config(rover))
    first = config["route"]["routes"][0]
    assert 'cause!=""' in first["matchers"]
    assert {"name": first["receiver"]} in config["receivers"]


@pytest.mark.real
def test_amtool_takes_the_configuration(rover, amtool, tmp_path):
    path = tmp_path / "alertmanager.yml"
    path.write_text(alertmanager_config(rover))
    done = subprocess.run([amtool, "check-config", path], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
    for labels, receiver in (
        (["reference=rover", "severity=error"], "roslens-urgent"),
        (["reference=rover", "severity=error", "cause=node:/lidar"], "roslens-consequences"),
        (["reference=rover", "severity=warning"], "roslens"),
    ):
        asked = [amtool, "config", "routes", "test", f"--config.file={path}", *labels]
        assert subprocess.run(asked, capture_output=True, text=True, check=True).stdout.strip() == receiver
