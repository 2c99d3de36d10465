"""What the rules of the graph find in a configuration of a workspace; its authors' comments and roles of files hold."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import msgspec

if TYPE_CHECKING:
    from roslens.cli.graph.graph_source import GraphSource
    from roslens.model.configuration import Configuration
    from roslens.model.finding import Finding
    from roslens.source.extract.ir.program import Program

_CODE = {".py": "python", ".cpp": "cpp", ".cc": "cpp", ".cxx": "cpp", ".hpp": "cpp", ".h": "cpp", ".hh": "cpp"}


def findings_of(
    source: GraphSource,
    configuration: Configuration,
    launch: str = "",
    given: Mapping[str, str] | None = None,
) -> list[Finding]:
    """Return what is wrong with a configuration, sorted by place.

    Findings that a comment in the source asks to leave out are left out; those in files that do not count for a gate
    say so.

    Args:
        source: the workspace that it was assembled from.
        configuration: what would run together.
        launch: its launch file; empty where it has none.
        given: arguments of the launch file.
    """
    from roslens.source.rules.graph import graph_findings
    from roslens.source.rules.graph.gather import surroundings_of

    declared = source.settings.graph.configurations.get(launch)
    launch, arguments = source.meant(launch, given or {})
    names = [one.name for one in source.facts.packages]
    surroundings = surroundings_of(
        configuration,
        launch=source.evaluated(launch, arguments)[1] if launch else None,
        given=arguments,
        packages=source.facts.packages,
        targets={name: source.facts.targets(name) for name in names},
        unresolved=source.facts.unresolved,
        paths={name: source.facts.paths(name) for name in names},
        programs=_calling(configuration, source),
        options=source.settings.options.get("graph", {}),
        content=source.reads.files.content,
        words=source.facts.files.content,
        noted=source.reads.names,
        together=bool(launch),
        started=declared is not None or bool(given),
        whole=declared is not None and declared.whole,
    )
    return list(_counted(graph_findings(configuration, surroundings), source, source.settings.gate_roles))


def _counted(found: Sequence[Finding], source: GraphSource, roles: Sequence[str]) -> Iterator[Finding]:
    from roslens.source.workspace.suppress import Suppression, suppressed

    hushed: dict[str, tuple[Suppression, ...]] = {}
    for finding in found:
        if finding.path not in hushed:
            hushed[finding.path] = source.reads.suppressions(finding.path, source.facts.files.content(finding.path))
        if not suppressed(finding.rule, finding.tags, finding.line, hushed[finding.path]):
            counts = source.facts.role(finding.path).value in roles
            yield finding if counts else msgspec.structs.replace(finding, gated=False)


def _calling(configuration: Configuration, source: GraphSource) -> Mapping[str, Program]:
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
        if (known := source.facts.program_of(path)) is not None:
            programs[path] = known
            continue
        language, text = _CODE.get(Path(path).suffix), source.reads.files.content(path)
        if language is not None and text is not None:
            programs[path] = parse_file(text, Language(language), source.settings.macros).program()
    return programs
