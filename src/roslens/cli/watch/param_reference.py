"""``--reference param:/roslens/reference``: documents that a launch file put into parameters."""

from __future__ import annotations

import argparse
import os
from collections.abc import Iterable
from pathlib import Path
from typing import TYPE_CHECKING

from roslens.model.errors import UsageError

if TYPE_CHECKING:
    from roslens.judge.reading.read_reference import GivenText, Source

PREFIX = "param:"


def add_reference_argument(parser: argparse._ActionsContainer) -> None:
    """Add what says how things should be, given as often as one likes."""
    parser.add_argument(
        "--reference",
        type=reference_argument,
        action="append",
        default=[],
        metavar="FILE",
        help="reference documents; param:/NAME reads one from a ROS parameter",
    )


def reference_argument(text: str) -> str | Path:
    """Return a path as one, and ``param:NAME`` as written."""
    return text if text.startswith(PREFIX) else Path(text)


def reference_sources(given: Iterable[str | Path], options: argparse.Namespace) -> list[Source]:
    """Return files as they are given, and in place of each parameter the documents it holds.

    Raises:
        UsageError: a parameter is not there.
        DocumentError: it holds no document.
    """
    found: list[Source] = []
    for one in given:
        found.extend(_documents(one.removeprefix(PREFIX), options) if isinstance(one, str) else (one,))
    return found


def _documents(name: str, options: argparse.Namespace) -> list[GivenText]:
    """Return the documents of a parameter in every ROS that is asked for, or found."""
    from roslens.live.observe.parameter_source import ros1_parameter, ros2_parameter
    from roslens.live.observe.reference_parameters import parameter_documents

    if options.bag:
        raise UsageError(f"--reference {PREFIX}{name} with --bag", expected="a file", advice="A bag has no parameters")
    if not name.startswith("/"):
        raise UsageError(f"--reference {PREFIX}{name}", expected=f"a name from the root on, {PREFIX}/{name}")
    asked = options.ros1 or options.ros2
    found: list[GivenText] = []
    errors: list[UsageError] = []
    if options.ros1 or (not asked and (options.master or os.environ.get("ROS_MASTER_URI"))):
        try:
            value, where = ros1_parameter(name, options.master or "")
            found += parameter_documents(name, value, where)
        except UsageError as error:
            errors.append(error)
    if options.ros2 or not asked:
        try:
            values, where = ros2_parameter(name, options.python or "", options.domain, os.environ)
            for parameter, value in sorted(values.items()):
                found += parameter_documents(parameter, value, where)
        except UsageError as error:
            errors.append(error)
    if not found:
        first = errors[0]
        others = "".join(f"; {error.what}" for error in errors[1:])
        raise UsageError(
            f"--reference {PREFIX}{name}: {first.what}{others}", expected=first.expected, advice=first.advice
        )
    return found
