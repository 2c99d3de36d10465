"""``roslens interfaces``: messages, services and actions, what changed in them, and who breaks."""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING

from roslens.cli.terminal.streams import add_stream_arguments
from roslens.cli.workplace.reading_options import add_reading_arguments

if TYPE_CHECKING:
    from pathlib import Path

    from roslens.model.interfaces.interface_change import InterfaceDifference
    from roslens.source.extract.workspace.interface_state import InterfaceState
    from roslens.source.settings import SourceSettings

TEXT = "List messages, services and actions with their type hash, or what changed in them and who breaks."
EXAMPLES = """\
  roslens interfaces                                  all of this folder, with RIHS01 (ROS 2) or MD5 (ROS 1)
  roslens interfaces --since v1.2.0                   what changed since a revision, and which nodes break
  roslens interfaces --since origin/main --recording drive.mcap --reference robot.yaml
  roslens interfaces --lock interfaces.lock           write down what is promised; commit it
  roslens interfaces --since interfaces.lock          keep the promise: exit code 1 where a change breaks it
  roslens interfaces --since v1.2.0 --fail-on unversioned    ... unless the version says so

exit codes: as everywhere; with --since 1 where a change breaks something (--fail-on says otherwise)"""
FAIL_ON = ("breaking", "unversioned", "never")


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add what is compared, with whom, and how it is written."""
    parser.add_argument("path", nargs="?", default=".", metavar="PATH", help="the workspace (default: this folder)")
    parser.add_argument("--since", metavar="REV|FILE", help="what changed since a revision, or since a lock file")
    parser.add_argument("--lock", metavar="FILE", help="write definitions and checksums to this file")
    parser.add_argument(
        "--recording", action="append", default=[], metavar="FILE", help="a bag that has to stay readable"
    )
    parser.add_argument(
        "--reference",
        action="append",
        default=[],
        metavar="FILE",
        help="a reference whose checks of fields have to hold",
    )
    parser.add_argument("--fail-on", choices=FAIL_ON, default="breaking", help="when the exit code is 1, with --since")
    parser.add_argument("--format", choices=("text", "markdown", "json"), default="text")
    parser.add_argument("-o", "--output", metavar="FILE", help="write to this file instead of standard output")
    add_reading_arguments(parser)
    add_stream_arguments(parser)


def run(options: argparse.Namespace) -> int:
    """Write interfaces or their changes and return the exit code.

    Raises:
        RoslensError: see :mod:`roslens.cli.terminal.boundary`.
    """
    from roslens.cli.interfaces.states import state_of_tree
    from roslens.cli.terminal.boundary import CLEAN, NOT_ANALYSED
    from roslens.cli.terminal.streams import write_result
    from roslens.cli.workplace.configuration import find_configuration
    from roslens.model.errors import UsageError
    from roslens.source.workspace.find import root_of

    if options.since and options.lock:
        raise UsageError("--since with --lock", expected="one of them")
    if (options.recording or options.reference) and not options.since:
        raise UsageError("--recording or --reference without --since", expected="--since REV or a lock file")
    root = root_of([options.path])
    settings = find_configuration(root, options.config).source
    state = state_of_tree(root, settings)
    _tell(state, options)
    if options.lock:
        from roslens.cli.interfaces.lock_file import lock_text

        write_result(lock_text(state), options.lock)
        return NOT_ANALYSED if state.failures else CLEAN
    if not options.since:
        write_result(_listed(state, options.format), options.output)
        return NOT_ANALYSED if state.failures else CLEAN
    return _since(options, root, settings, state)


def _since(options: argparse.Namespace, root: Path, settings: SourceSettings, state: InterfaceState) -> int:
    from roslens.cli.graph.graph_opened import open_source
    from roslens.cli.interfaces.states import state_before
    from roslens.cli.interfaces.users import with_users
    from roslens.cli.terminal.boundary import CLEAN, FINDINGS, NOT_ANALYSED
    from roslens.cli.terminal.streams import write_result
    from roslens.source.extract.workspace.interface_state import interface_difference

    title, before = state_before(root, options.since, settings)
    found = interface_difference(before, state)
    if found.on_wire:
        with open_source(options) as source:
            started = source.packages(())
            found = with_users(found, (*started, *source.unstarted((), started)), options.recording, options.reference)
    write_result(_written(found, title, options.format), options.output)
    if fails(found, options.fail_on):
        return FINDINGS
    return NOT_ANALYSED if state.failures else CLEAN


def fails(found: InterfaceDifference, on: str) -> bool:
    """Return whether a difference is one to fail on."""
    if on == "never" or not found.breaking:
        return False
    if on == "breaking":
        return True
    versioned = {one.package for one in found.steps if one.enough}
    return any(one.interface.partition("/")[0] not in versioned for one in found.breaking)


def _tell(state: InterfaceState, options: argparse.Namespace) -> None:
    import sys

    for failure in () if options.quiet else state.failures:
        print(f"roslens: {failure}", file=sys.stderr)


def _written(found: InterfaceDifference, title: str, form: str) -> str:
    from roslens.report.run.interface_text import SCHEMA, interface_document, interface_lines, interface_markdown

    if form == "json":
        import msgspec

        document = {"schema": SCHEMA, "since": title, **interface_document(found)}
        return msgspec.json.format(msgspec.json.encode(document), indent=1).decode() + "\n"
    if form == "markdown":
        return f"### roslens: since `{title}`\n\n" + (interface_markdown(found) or "No interface changed.\n")
    return "".join(f"{line}\n" for line in (f"since {title}", *interface_lines(found)))


def _listed(state: InterfaceState, form: str) -> str:
    if form == "json":
        from roslens.cli.interfaces.lock_file import lock_text

        return lock_text(state)
    rows = [
        (one.interface.full_name, one.checksum.text or f"unknown: {one.checksum.unknown}", one.path)
        for one in state.interfaces
    ]
    if form == "markdown":
        head = ["| interface | checksum | file |", "| --- | --- | --- |"]
        return "\n".join([*head, *(f"| `{a}` | `{b}` | {c} |" for a, b, c in rows)]) + "\n"
    return "".join(f"{name}  {checksum}  {path}\n" for name, checksum, path in rows) or "no interfaces\n"
