"""``--reference param:/roslens/reference``: documents that a launch file put into parameters."""

from __future__ import annotations

import argparse
import os
from collections.abc import Iterable
from pathlib import Path
from typing import TYPE_CHECKING

from roslens.cli.watch.which_ros import is_any_asked, wants_ros1
from roslens.model.errors import UsageError

if TYPE_CHECKING:
    from roslens.judge.reading.read_reference import GivenText, Source

PREFIX = "param:"


def add_reference_argument(parser: argparse._ActionsContainer) -> None:
    """Add the option for references, which may be repeated."""
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
    if options.bag:
        raise UsageError(f"--reference {PREFIX}{name} with --bag", expected="a file", advice="A bag has no parameters")
    if not name.startswith("/"):
        raise UsageError(f"--reference {PREFIX}{name}", expected=f"a name from the root on, {PREFIX}/{name}")
    readers = [_of_ros1] if wants_ros1(options) else []
    readers += [_of_ros2] if options.ros2 or not is_any_asked(options) else []
    found: list[GivenText] = []
    errors: list[UsageError] = []
    for read in readers:
        try:
            found += read(name, options)
        except UsageError as error:
            errors.append(error)
    if not found:
        first = errors[0]
        others = "".join(f"; {error.what}" for error in errors[1:])
        raise UsageError(
            f"--reference {PREFIX}{name}: {first.what}{others}", expected=first.expected, advice=first.advice
        )
    return found


def _of_ros1(name: str, options: argparse.Namespace) -> list[GivenText]:
    from roslens.live.observe.parameter_source import ros1_parameter
    from roslens.live.observe.reference_parameters import parameter_documents

    value, where = ros1_parameter(name, options.master or "")
    return list(parameter_documents(name, value, where))


def _of_ros2(name: str, options: argparse.Namespace) -> list[GivenText]:
    from roslens.live.observe.parameter_source import ros2_parameter
    from roslens.live.observe.reference_parameters import parameter_documents

    values, where = ros2_parameter(name, options.python or "", options.domain, os.environ)
    return [one for parameter, value in sorted(values.items()) for one in parameter_documents(parameter, value, where)]
