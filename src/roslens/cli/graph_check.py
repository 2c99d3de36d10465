"""``roslens graph --check``: what does not fit together in a computation graph, and whether that fails."""

from __future__ import annotations

import argparse
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path
from typing import TYPE_CHECKING

from roslens.cli.boundary import CLEAN, FINDINGS
from roslens.model.errors import UsageError

if TYPE_CHECKING:
    from roslens.cli.configuration import Configuration as Settings
    from roslens.cli.graph_source import GraphSource
    from roslens.model.configuration import Configuration
    from roslens.model.finding import Finding
    from roslens.source.extract.program import Program

_CODE = {".py": "python", ".cpp": "cpp", ".cc": "cpp", ".cxx": "cpp", ".hpp": "cpp", ".h": "cpp", ".hh": "cpp"}


def add_check_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the options of checking."""
    parser.add_argument("--check", action="store_true", help="tell what does not fit together instead of the graph")
    parser.add_argument(
        "--fail-on",
        choices=("note", "warning", "error", "never"),
        help="with --check: exit with 1 from this severity on (default: error)",
    )


def check(source: GraphSource, found: tuple[Configuration, ...], options: argparse.Namespace) -> int:
    """Write the findings and return the exit code.

    Raises:
        UsageError: a format that findings have not.
    """
    if options.format not in ("text", "json"):
        raise UsageError(f"--format {options.format} with --check", expected="text or json")
    from roslens.cli.commands.graph import write
    from roslens.cli.configuration import find_configuration
    from roslens.model.finding import Severity
    from roslens.source.workspace.find import root_of

    settings = find_configuration(root_of([options.path]), options.config)
    findings = [finding for one in found for finding in findings_of(source, one, options, settings)]
    fail_on = options.fail_on or settings.fail_on
    fails = fail_on != "never" and any(one.severity.rank >= Severity(fail_on).rank for one in findings)
    write((_json if options.format == "json" else _text)(findings), options.output)
    return FINDINGS if fails else CLEAN


def findings_of(
    source: GraphSource, configuration: Configuration, options: argparse.Namespace, settings: Settings
) -> list[Finding]:
    """Return what the rules of the graph find in a configuration of a workspace."""
    from roslens.cli.graph_source import arguments_of
    from roslens.source.rules.graph import graph_findings
    from roslens.source.rules.graph.gather import surroundings_of

    given = arguments_of(options.arg)
    names = [one.name for one in source.facts.packages]
    targets = {name: source.facts.targets(name) for name in names}
    surroundings = surroundings_of(
        configuration,
        launch=source.evaluated(options.launch, given)[1] if options.launch else None,
        given=given,
        packages=source.facts.packages,
        targets=targets,
        unresolved=source.facts.unresolved,
        paths={name: source.facts.paths(name) for name in names},
        programs=_calling(configuration, source.facts.files.content, settings),
        options=settings.source.options.get("graph", {}),
    )
    return graph_findings(configuration, surroundings)


def _calling(
    configuration: Configuration, content: Callable[[str], bytes | None], settings: Settings
) -> Mapping[str, Program]:
    """Return the programs that call services: only those may wait for one."""
    from roslens.model.graph import Role
    from roslens.model.source import Language
    from roslens.source.parsed_file import parse_file

    paths = {
        site.path
        for node in configuration.nodes
        for one in node.endpoints
        if one.endpoint.role is Role.SERVICE_CLIENT
        for site in one.sites
    }
    programs = {}
    for path in sorted(paths):
        language, text = _CODE.get(Path(path).suffix), content(path)
        if language is not None and text is not None:
            programs[path] = parse_file(text, Language(language), settings.source.macros).program()
    return programs


def _json(findings: list[Finding]) -> str:
    import msgspec

    return msgspec.json.format(msgspec.json.encode(findings), indent=1).decode() + "\n"


def _text(findings: list[Finding]) -> str:
    return "".join(_lines(findings)) or "nothing found\n"


def _lines(findings: list[Finding]) -> Iterator[str]:
    for one in findings:
        place = f"{one.path}:{one.line}" if one.line else one.path
        yield f"{place}: {one.severity.value}: {one.message} [{one.rule}]\n"
