"""``roslens graph --check``: what does not fit together in a computation graph, and whether that fails."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

from roslens.cli.terminal.boundary import CLEAN, FINDINGS
from roslens.model.errors import UsageError

if TYPE_CHECKING:
    from roslens.cli.graph.graph_source import GraphSource
    from roslens.model.configuration import Configuration
    from roslens.model.finding import Finding
    from roslens.model.graphs.completeness import Completeness


def add_check_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the options of checking."""
    parser.add_argument("--check", action="store_true", help="report what does not fit together instead of the graph")
    parser.add_argument(
        "--fail-on",
        choices=("note", "warning", "error", "never"),
        help="with --check: exit with 1 at this severity or above (default: error)",
    )


def check(source: GraphSource, found: tuple[Configuration, ...], options: argparse.Namespace) -> int:
    """Write the findings and return the exit code.

    Raises:
        UsageError: a format that findings have not.
    """
    if options.format not in ("text", "json"):
        raise UsageError(f"--format {options.format} with --check", expected="text or json")
    from roslens.cli.graph.graph_findings import findings_of
    from roslens.cli.graph.graph_source import arguments_of
    from roslens.cli.terminal.streams import write_result
    from roslens.cli.workplace.configuration import find_configuration
    from roslens.model.finding import Severity
    from roslens.model.graphs.completeness import completeness_of
    from roslens.source.workspace.find import root_of

    settings = find_configuration(root_of([options.path]), options.config)
    given = arguments_of(options.arg)
    every = (finding for one in found for finding in findings_of(source, one, options.launch or "", given))
    # The worst first; those of one severity stay sorted by place.
    findings = sorted(every, key=lambda one: -one.severity.rank)
    fail_on = options.fail_on or settings.fail_on
    fails = fail_on != "never" and any(one.gated and one.severity.rank >= Severity(fail_on).rank for one in findings)
    known = tuple(map(completeness_of, found))
    write_result(_json(findings) if options.format == "json" else _text(findings, known), options.output)
    if not options.quiet:
        print(f"roslens: {_counted(findings, sum(len(one.unresolved) for one in found), fail_on)}", file=sys.stderr)
        for one in known:
            _tell(one)
    return FINDINGS if fails else CLEAN


def _json(findings: list[Finding]) -> str:
    import msgspec

    return msgspec.json.format(msgspec.json.encode(findings), indent=1).decode() + "\n"


def _text(findings: list[Finding], known: Sequence[Completeness]) -> str:
    if findings:
        return "".join(_lines(findings))
    return "nothing found\n" if all(one.is_whole for one in known) else f"{_nothing(known)}\n"


def _nothing(known: Sequence[Completeness]) -> str:
    """Return what no finding means where a graph is not known whole: less than that nothing is wrong."""
    said = "; ".join(one.said() for one in known if not one.is_whole)
    if all(one.is_unread for one in known):
        return f"could not be checked: {said}"
    return f"nothing found in what is known: {said}"


def _tell(known: Completeness) -> None:
    """Report on standard error why a graph is not whole."""
    if known.is_whole or not (known.nodes or known.missing):
        return
    print(f"roslens: {known.said()}", file=sys.stderr)
    for line in known.why():
        print(f"roslens:   {line}", file=sys.stderr)


def _counted(findings: list[Finding], missed: int, fail_on: str) -> str:
    """Return the number of findings of each severity, the severity that fails, and what could not be checked."""
    words = [
        f"{count} {word}{'s' * (count != 1)}"
        for word in ("error", "warning", "note")
        if (count := sum(one.severity.value == word for one in findings))
    ]
    said = f"{', '.join(words)}; --fail-on {fail_on}" if words else "no findings"
    if missed:
        said += f"; {missed} place{'s' * (missed != 1)} could not be resolved and raise nothing, see it without --check"
    return said


def _lines(findings: list[Finding]) -> Iterator[str]:
    for one in findings:
        place = f"{one.path}:{one.line}" if one.line else one.path
        yield f"{place}: {one.severity.value}: {one.message} [{one.rule}]\n"
