"""The options of commands that read the source of a workspace: configuration, worker processes, cache."""

from __future__ import annotations

import argparse


def add_reading_arguments(parser: argparse.ArgumentParser) -> None:
    """Add ``--config``, ``--jobs`` and ``--no-cache``."""
    parser.add_argument("--config", metavar="FILE", help="configuration (default: the nearest roslens.toml)")
    parser.add_argument("--jobs", type=int, metavar="N", help="worker processes (default: one per processor)")
    parser.add_argument("--no-cache", action="store_true", help="read every file again, and keep nothing")
