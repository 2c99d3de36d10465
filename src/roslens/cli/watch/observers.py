"""What is observed: the options that `watch` and `reference draft --live` share."""

from __future__ import annotations

import argparse
from pathlib import Path

NAMES = ("ros1", "ros2", "master", "domain", "python", "tap", "listen", "key_file")
"""As argparse keeps them."""


def add_observer_arguments(parser: argparse._ActionsContainer) -> None:
    """Add which ROS is observed, through what, and who else may report."""
    parser.add_argument("--ros1", action="store_true", help="observe ROS 1 (default: every ROS that is found)")
    parser.add_argument("--ros2", action="store_true", help="observe ROS 2 (default: every ROS that is found)")
    parser.add_argument("--master", metavar="URI", help="of ROS 1 (default: $ROS_MASTER_URI)")
    parser.add_argument("--domain", type=int, metavar="N", help="of ROS 2 (default: $ROS_DOMAIN_ID)")
    parser.add_argument(
        "--python", metavar="FILE", help="a Python with rclpy (default: $ROSLENS_ROS2_PYTHON, this one)"
    )
    parser.add_argument(
        "--tap",
        action="append",
        default=[],
        metavar="PATTERN",
        help="subscribe to topics that match, within a budget; for nodes that were not started through `roslens run`",
    )
    parser.add_argument("--listen", metavar="HOST:PORT", help="accept reports of `roslens agent` on other hosts")
    parser.add_argument(
        "--key-file",
        type=Path,
        action="append",
        default=[],
        metavar="FILE",
        help="the key shared with agents; may be repeated, for hosts with their own keys",
    )


def given(options: argparse.Namespace) -> str:
    """Return the first of these options that was given, as it is written; empty where none was."""
    return next((f"--{name.replace('_', '-')}" for name in NAMES if getattr(options, name)), "")
