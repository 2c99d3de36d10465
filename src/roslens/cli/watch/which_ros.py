"""Which generations of ROS an observing command is about: those that were asked for, or that are found here."""

from __future__ import annotations

import argparse
import os


def is_any_asked(options: argparse.Namespace) -> bool:
    """Whether options name a generation of ROS."""
    return bool(options.ros1 or options.ros2)


def wants_ros1(options: argparse.Namespace) -> bool:
    """Whether ROS 1 is asked for, or nothing is and there is the address of a master."""
    if is_any_asked(options):
        return bool(options.ros1)
    return bool(options.master or os.environ.get("ROS_MASTER_URI"))
