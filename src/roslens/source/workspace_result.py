"""The results of a run on the workspace as a whole, and on itself."""

from __future__ import annotations

from collections import Counter
from collections.abc import Collection, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import msgspec

from roslens.model.failure import Failure
from roslens.model.result import RunHeader, WorkspaceResult
from roslens.source.plugin_stage import PluginStage
from roslens.source.repositories import repositories_of
from roslens.source.run_inputs import Run
from roslens.source.set_aside_in_run import whole_run
from roslens.source.tools.running.layout import RULE as LAYOUT
from roslens.source.workspace.silence import RULES as SUPPRESSION_RULES

if TYPE_CHECKING:
    from roslens.judge.quality.quality_model import QualityModel
    from roslens.model.finding import Finding
    from roslens.plugins.outcome import Outcome


def workspace_result(
    run: Run,
    stage: PluginStage,
    models: Sequence[QualityModel],
    owned: dict[str, tuple[Finding, ...]],
    rest: Sequence[Outcome],
    seen: Collection[str],
    used: frozenset[str],
) -> WorkspaceResult:
    """Return what belongs to the workspace, and to no package."""
    from roslens.judge.quality.quality_model import rules_of
    from roslens.source.metrics.measure_workspace import measure_workspace
    from roslens.source.metrics.table import QUANTITIES
    from roslens.source.rules.table import native_rules

    failures: list[Failure] = [
        failure for failure in (*run.workspace.failures, *run.inventory.failures) if not failure.package
    ]
    further = run.beyond.rules if run.beyond else ()
    judging = (rule for model in models for rule in rules_of(model))
    native = (rule.info for rule in native_rules().values())
    of_tools = run.tools.rules(seen) if run.tools else ()
    own = (*native, LAYOUT, *SUPPRESSION_RULES)
    rules = {rule.id: rule for rule in (*of_tools, *stage.rules, *further, *judging, *own)}
    whole = whole_run(
        run.silence,
        owned,
        [finding for outcome in rest for finding in outcome.findings],
        used,
        root=Path(run.workspace.root),
        base=run.base,
        judged=rules,
    )
    return WorkspaceResult(
        package_values=measure_workspace([found.package for found in run.workspace.packages]),
        package_findings=whole.owned,
        findings=whole.none,
        failures=(
            *failures,
            *run.plugins.failures,
            *(run.tools.failures if run.tools else ()),
            *(failure for outcome in rest for failure in outcome.failures),
        ),
        rules=tuple(rules[key] for key in sorted(rules)),
        quantities=tuple({**QUANTITIES, **stage.quantities}.values()),
        set_aside=whole.set_aside,
    )


def header_of(run: Run) -> RunHeader:
    """Return the results of a run on itself."""
    from roslens.source.commit import commit_of
    from roslens.source.versions import tool_versions

    files = (file for held in run.inventory.files.values() for file in held)
    past = run.revision
    return RunHeader(
        key=run.key_kept(run.key),
        root=past.root if past else run.workspace.root,
        started=run.clock.utc,
        commit=past.commit if past else commit_of(run.workspace.root, files),
        tools=tool_versions(run.plugins.members) | (run.tools.versions if run.tools else {}),
        configuration=_configuration(run),
        models=run.settings.models,
        repositories=repositories_of(run.workspace, run.inventory.files, run.fetched),
    )


def _configuration(run: Run) -> dict[str, object]:
    """Return the options, and for which distributions the packages are, in words."""
    notes = Counter(one.target.note() for one in run.around.values() if one.target.distros)
    options: dict[str, object] = msgspec.to_builtins(run.settings)
    if notes:
        (first, _), *others = notes.most_common()
        options["target"] = f"{first}; others differ" if others else first
    return options
