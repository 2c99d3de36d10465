"""A process that reads parameters of one node and writes them as JSON: ``<node> <parameter>``.

Beside the parameter itself, those below it are written (``reference.arm`` below ``reference``), by full name.
"""

from __future__ import annotations

import argparse
import json
import os
import sys
import time
from typing import Any

from roslens.live.adapters.ros2.graph import OWN
from roslens.live.adapters.ros2.parameters import NodeQuestions

NOT_THERE = 4
"""The exit code if the node does not answer."""
_LOOK_S = 0.02


def selected(values: dict[str, Any], name: str) -> dict[str, Any]:
    """Return of all parameters the one of this name, and those below it."""
    return {one: value for one, value in sorted(values.items()) if one == name or one.startswith(f"{name}.")}


def read(node: Any, name: str, parameter: str, wait_s: float) -> dict[str, Any] | None:
    """Return parameters of the node ``name``; None where it does not answer within ``wait_s`` seconds."""
    wanted = lambda one: one == parameter or one.startswith(f"{parameter}.")  # noqa: E731
    questions = NodeQuestions(node, name, wanted=wanted, shown=lambda _, value: value)
    end = time.monotonic() + wait_s
    try:
        while (values := questions.step()) is None and time.monotonic() < end:
            time.sleep(_LOOK_S)
    finally:
        questions.close()
    return None if values is None else selected(values, parameter)


def main(words: list[str]) -> int:
    """Run; return the exit code."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("node")
    parser.add_argument("parameter")
    parser.add_argument("--domain", type=int)
    parser.add_argument("--wait", type=float, default=5.0)
    options = parser.parse_args(words)
    # What libraries print must not get into the answer.
    answer = os.fdopen(os.dup(1), "w")
    os.dup2(2, 1)
    import rclpy

    rclpy.init(args=[], domain_id=options.domain)
    node = rclpy.create_node(
        f"{OWN[1:]}reading_{os.getpid()}", namespace="/", enable_rosout=False, start_parameter_services=False
    )
    try:
        values = read(node, options.node, options.parameter, options.wait)
    finally:
        node.destroy_node()
        rclpy.try_shutdown()
    if values is None:
        return NOT_THERE
    json.dump(values, answer, default=list)
    answer.close()
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
