"""Reads one parameter of a running system, of ROS 1 or ROS 2, and everything below it."""

from __future__ import annotations

import json
import os
import subprocess
from collections.abc import Mapping
from typing import Any

from roslens.children.safe_path import NEUTRAL
from roslens.live.adapters.child import clean_environment, find_ros2_python, ros2_command
from roslens.model.errors import UsageError

WAIT_S = 5.0
"""How long a node of ROS 2 may take to be met and to answer."""
_START_S = 20.0
_MODULE = "roslens.live.adapters.ros2.read_parameters"
_MASTER = "http://localhost:11311"


def ros1_parameter(name: str, master: str) -> tuple[Any, str]:
    """Return a parameter of ROS 1 and what holds it; a namespace is a table.

    Raises:
        UsageError: there is no such parameter, or no master.
    """
    from roslens.live.adapters.ros1.master import Master
    from roslens.live.adapters.ros1.resolve import Resolver
    from roslens.live.adapters.ros1.wire.xml_rpc import CallError, Trouble

    uri = master or os.environ.get("ROS_MASTER_URI") or _MASTER
    server = Master(uri, "/roslens_reference", Resolver(), WAIT_S)
    try:
        return server.parameter(name), f"the parameter server at {uri}"
    except CallError as error:
        if error.trouble is Trouble.DENIED:
            raise UsageError(
                f"no parameter {name!r} at the parameter server at {uri}", expected="one that holds a reference",
                advice=f'A launch file puts it there: <rosparam param="{name}" file="…"/>',
            ) from None  # fmt: skip
        raise UsageError(
            f"no ROS master: {error}", expected="one that holds the parameter", advice="Start roscore, or give --master"
        ) from None
    finally:
        server.close()


def ros2_parameter(
    name: str, python: str, domain: int | None, environment: Mapping[str, str]
) -> tuple[dict[str, Any], str]:
    """Return a parameter of a node of ROS 2 and those below it, by name, and what holds them.

    Args:
        name: ``/node/parameter``, or ``/node:parameter`` where the parameter has a ``/`` itself.
        python: one with rclpy; empty for that which is found.
        domain: None for that of the environment.
        environment: of this process.

    Raises:
        UsageError: there is no such parameter, node or Python.
    """
    node, parameter = split_name(name)
    words = [node, parameter, "--wait", str(WAIT_S), *(["--domain", str(domain)] if domain is not None else [])]
    command = ros2_command(find_ros2_python(python, environment), words, _MODULE)
    try:
        ended = subprocess.run(
            command, env=clean_environment(environment), capture_output=True, text=True, check=False,
            timeout=WAIT_S + _START_S, cwd=NEUTRAL, stdin=subprocess.DEVNULL,
        )  # fmt: skip
        values = json.loads(ended.stdout) if not ended.returncode else None
    except (subprocess.TimeoutExpired, ValueError) as error:
        raise UsageError(f"the parameters of {node} cannot be read: {error}") from None
    if values:
        return values, f"node {node}"
    if values is not None:
        raise UsageError(
            f"node {node} has no parameter {parameter!r}", expected="one that holds a reference as text",
            advice="Declare it in the node, or give it in the launch file",
        )  # fmt: skip
    said = (ended.stderr.strip().splitlines() or [""])[-1] if ended.returncode not in (0, 4) else ""
    raise UsageError(
        f"no node {node} answers in {WAIT_S:g} s{f': {said}' if said else ''}", expected="one that has the parameter",
        advice="Start it before, or see whether --domain is its domain",
    )  # fmt: skip


def split_name(name: str) -> tuple[str, str]:
    """Return node and parameter of ``/node/parameter`` or ``/node:parameter``.

    Raises:
        UsageError: the name has not these parts.
    """
    node, colon, parameter = name.partition(":")
    if not colon:
        node, _, parameter = name.rpartition("/")
    if not node.startswith("/") or not parameter or len(node) < 2:
        raise UsageError(f"{name!r} names no parameter of a node", expected="/node/parameter")
    return node, parameter
