"""What tools report, made into findings: placed, with severity, tags and fingerprints that survive moved lines."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence

import msgspec

from roslens.model.entity import EntityId, EntityKind
from roslens.model.finding import RuleInfo, Severity
from roslens.model.source import SourceFile
from roslens.plugins.grounds import Grounds, package_grounds
from roslens.plugins.outcome import Outcome, RawFinding, settle
from roslens.plugins.points import FileInput, PackageInput
from roslens.source.measure.analyse_package import MeasuredPackage
from roslens.source.tools.checks.tool_checks import checks_of, rule_id, rule_of
from roslens.source.tools.tool import ToolFinding
from roslens.source.workspace.find import Workspace

_Place = tuple[str, int, int, str, str]


def outcome_of(
    tool: str,
    found: Iterable[ToolFinding],
    measured: MeasuredPackage,
    workspace: Workspace,
    files: Sequence[SourceFile],
    imported: Mapping[str, RuleInfo],
) -> Outcome:
    """Return the findings of one tool in one package; ``imported`` are rules that no data file describes."""
    grounds = _grounds(measured, workspace, files)
    levels: dict[_Place, Severity] = {}
    raw: list[RawFinding] = []
    checks = checks_of(tool)
    rules: dict[str, RuleInfo] = {}
    for one in sorted(found):
        identity = rule_id(tool, one.check)
        rules.setdefault(identity, imported.get(identity) or rule_of(tool, one.check))
        severity = checks.severity_of(one.check, one.level)
        levels[one.path, one.line, one.column, identity, one.message] = severity
        raw.append(_placed(one, identity, grounds))
    outcome = settle(tool, rules, raw, (), ())
    findings = tuple(
        msgspec.structs.replace(
            finding,
            severity=levels[finding.path, finding.line, finding.column, finding.rule, finding.message],
        )
        for finding in outcome.findings
    )
    return msgspec.structs.replace(outcome, findings=findings)


def _placed(one: ToolFinding, identity: str, grounds: Grounds) -> RawFinding:
    around = grounds.around(one.path, one.line) if one.line else ()
    entity = around[0].id if around else str(EntityId(EntityKind.FILE, one.path))
    context = (grounds.line_text(one.path, one.line) or "") if one.line else ""
    return RawFinding(
        one.path, one.line, one.column, identity, entity, one.message, one.end_line, one.end_column, context
    )


def _grounds(measured: MeasuredPackage, workspace: Workspace, files: Sequence[SourceFile]) -> Grounds:
    found = next(found for found in workspace.packages if found.package.id == measured.package)
    given = tuple(FileInput(file.path, "", file.language, file.role, measured.package, b"") for file in files)
    return package_grounds(PackageInput(found.package, found.folder, given, measured.entities), root=workspace.root)
