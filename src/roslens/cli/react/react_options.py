"""By whom something may be done about faults, and how much: options of `react` and of `serve --react`."""

from __future__ import annotations

import argparse
from pathlib import Path


def add_hand_arguments(parser: argparse.ArgumentParser | argparse._ArgumentGroup) -> None:
    """Add by whom something may be done."""
    parser.add_argument(
        "--allow", type=Path, metavar="FILE", help="which actions on processes of this host are allowed"
    )
    parser.add_argument(
        "--enrolled", type=Path, metavar="FOLDER", help="ask agents that `roslens agent --enrol` enrolled"
    )
    parser.add_argument(
        "--agents", metavar="HOST[:PORT]", help="address that agents connect to (default: 0.0.0.0:7412)"
    )


def add_limit_arguments(parser: argparse.ArgumentParser) -> None:
    """Add how much may be done."""
    limits = parser.add_argument_group("limits")
    limits.add_argument(
        "--cool-down", default="10s", metavar="TIME", help="between two runs of one action on one target (default: 10s)"
    )
    limits.add_argument(
        "--at-most", type=int, default=10, metavar="N", help="actions per minute in total (default: 10)"
    )
    limits.add_argument(
        "--most-restarts", type=int, default=3, metavar="N",
        help="of a node in 10 minutes, then it is given up until `roslens react --release` (default: 3)",
    )  # fmt: skip
    limits.add_argument(
        "--maintenance", action="append", default=[], metavar="WINDOW",
        help="when no action is carried out: `Mon-Fri 22:00-23:30`; may be given again",
    )  # fmt: skip
