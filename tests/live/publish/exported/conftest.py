import shutil
from pathlib import Path

import pytest

from roslens.judge.reading.read_reference import GivenText, load_reference
from roslens.live.window.signals import BY_KEY

UNPACKED = Path(__file__).parents[4] / "build" / "unpacked" / "usr" / "bin"
"""Where `make parts` unpacks what would start a service if it were installed."""

TEXT = """\
kind: reference
name: rover
title: A small robot
defaults: {group: driving}
constraints:
  - {topic: /scan, rate: 25 Hz ± 15 %, severity: error, text: 'Look at "{{ the }}" cable'}
  - {topic: "/camera/**", bandwidth: <= 20 MB/s, without: ["/camera/raw"]}
  - {connection: /scan, subscriber: /planner, latency: <= 20 ms, group: ""}
  - {node: "/{lidar,planner}", cpu: <= 80 %}
  - {host: "*", disk_share: <= 95 %}
  - {node: /planner, expected: always, severity: error}
  - {topic: "re:/scan(?#front)", rate: ">= 1 Hz"}
fields:
  - {topic: /scan, field: "ranges[0]", range: 0.1..30}
"""


@pytest.fixture
def rover():
    return load_reference([GivenText("rover.yaml", TEXT.encode())], BY_KEY)


def _program(name):
    found = shutil.which(name) or shutil.which(name, path=UNPACKED)
    if found is None:
        pytest.skip(f"no {name}: `make parts` unpacks that of Debian")
    return found


@pytest.fixture
def promtool():
    return _program("promtool")


@pytest.fixture
def amtool():
    return _program("amtool")
