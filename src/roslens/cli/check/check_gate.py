"""Whether a run passes the ``[gate]`` of its configuration."""

from __future__ import annotations

from collections import Counter
from collections.abc import Collection, Iterable
from typing import TYPE_CHECKING

import msgspec

from roslens.judge.quality.gate import GateConditions, GateFacts, GateResult, Lines, evaluate
from roslens.model.entity import EntityKind
from roslens.model.failure import Failure
from roslens.model.finding import Finding
from roslens.model.source import Role

if TYPE_CHECKING:
    from roslens.cli.check.check_scope import Scope
    from roslens.store.read import RunView


def gated(scope: Scope, conditions: GateConditions | None) -> Scope:
    """Return the scope with the results of the conditions; what cannot be determined becomes a failure."""
    if conditions is None:
        return scope
    results = tuple(evaluate(conditions, _facts(scope, conditions)))
    wanted = msgspec.structs.replace(scope.wanted, gate=results)
    failures = tuple(_failed(one) for one in results if one.holds is None)
    if not failures:
        return msgspec.structs.replace(scope, wanted=wanted)
    from roslens.store.narrowed import with_failures

    shown, judged = with_failures(scope.shown, failures), with_failures(scope.judged, failures)
    return msgspec.structs.replace(scope, shown=shown, judged=judged, wanted=wanted)


def _facts(scope: Scope, conditions: GateConditions) -> GateFacts:
    tags = scope.wanted.tags
    baseline = scope.baseline
    files = {file.path: file for _, file in scope.judged.files() if file.role is Role.OWN}
    ratio = conditions.comment_ratio is not None or conditions.comment_ratio_of_new_code is not None
    new_files = None
    interfaces = None if baseline is None else baseline.interfaces
    if baseline is not None and baseline.files is not None:
        before = set(baseline.files.values())
        new_files = {path for path, file in files.items() if file.content_hash not in before}
    return GateFacts(
        _counts(scope.whole.findings(tags=tags)),
        _lines(scope.judged, files) if ratio else Lines(),
        _counts(scope.judged.findings(tags=tags)) if baseline is not None else None,
        _lines(scope.judged, new_files) if ratio and new_files is not None else None,
        None if interfaces is None else tuple(sorted({one.interface for one in interfaces.breaking})),
    )


def _counts(findings: Iterable[Finding]) -> dict[str, int]:
    return dict(Counter(f"{one.severity.value}s" for one in findings if one.gated))


def _lines(view: RunView, files: Collection[str]) -> Lines:
    code = comment = 0.0
    for entity in view.entities(kind=EntityKind.FILE):
        if entity.path in files:
            code += entity.values.get("loc", 0)
            comment += entity.values.get("comment_lines", 0)
    return Lines(code, comment)


def _failed(result: GateResult) -> Failure:
    return Failure(
        "gate",
        f"[gate] {result.condition}: {result.text}",
        "a baseline to compare with, with its files",
        "Give --baseline REV, RUN or a JSON report",
    )
