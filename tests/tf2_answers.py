"""Look-ups of the buffer of roslens, and of tf2 itself beside the system's Python."""

import json
import subprocess
from functools import cache
from pathlib import Path

import msgspec
import pytest

from roslens.model.transforms.buffer import TransformBuffer
from roslens.model.transforms.lookup import TransformError

SYSTEM_PYTHON = "/usr/bin/python3"
PRECISION_NS = 300
"""tf2_py returns stamps as seconds in a double, which has 0.24 us for those of today."""
TRUTH = Path(__file__).with_name("tf2_truth.py")


@cache
def has_tf2():
    probe = [SYSTEM_PYTHON, "-c", "import tf2_py, rospy, geometry_msgs.msg"]
    try:
        return subprocess.run(probe, capture_output=True, check=False).returncode == 0
    except OSError:
        return False


def mine(transforms, asked):
    buffer = TransformBuffer()
    for one in transforms:
        buffer.put(one)
    found = []
    for target, source, time in asked:
        try:
            found.append(msgspec.to_builtins(buffer.look_up(target, source, time)))
        except TransformError as error:
            found.append({"error": f"{error.kind}Exception"})
    return found


def truths(cases):
    lines = "".join(
        json.dumps({"transforms": msgspec.to_builtins(transforms), "asked": asked}) + "\n"
        for transforms, asked in cases
    )
    done = subprocess.run(
        [SYSTEM_PYTHON, str(TRUTH)], input=lines, capture_output=True, text=True, check=False, timeout=300
    )
    assert done.returncode == 0, done.stderr[-2000:]
    return [json.loads(line) for line in done.stdout.splitlines()]


def alike(one, other):
    if "error" in one or "error" in other:
        return one == other
    turned = sum(a * b for a, b in zip(one["rotation"], other["rotation"], strict=True))
    return (
        abs(one["stamp"] - other["stamp"]) <= PRECISION_NS
        and one["translation"] == pytest.approx(other["translation"], abs=1e-9)
        and abs(abs(turned) - 1) < 1e-9
    )
