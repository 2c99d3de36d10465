"""Only one process acts on a ROS system of a host."""

import contextlib
import os
import subprocess
import sys

import pytest

from roslens.cli.react.sole_reactor import hold_alone
from roslens.model.errors import UsageError

HOLD = """
import contextlib, sys
from roslens.cli.react.sole_reactor import hold_alone
with contextlib.ExitStack() as stack:
    hold_alone(stack, sys.argv[1:])
    print("held", flush=True)
    sys.stdin.read()
"""


@pytest.fixture
def system():
    return f"domain of test {os.getpid()}"


def refused(system, words):
    with contextlib.ExitStack() as stack, pytest.raises(UsageError, match=words):
        hold_alone(stack, [system])


def test_a_second_one_is_refused_with_the_name_of_the_first(system):
    other = subprocess.Popen(
        [sys.executable, "-c", HOLD, system], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True
    )
    assert other.stdout.readline() == "held\n"
    refused(system, f"process {other.pid} of user {os.getuid()} .* acts on {system}")
    other.kill()
    other.communicate()
    with contextlib.ExitStack() as stack:
        hold_alone(stack, [system, f"{system} 2"])
        refused(system, "this process")
    with contextlib.ExitStack() as stack:
        hold_alone(stack, [system])


def test_other_systems_are_no_matter(system):
    with contextlib.ExitStack() as stack:
        hold_alone(stack, [system])
        hold_alone(stack, [f"{system} 2"])
