"""The rules that a comment in a package may name, and which of them looked at it."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence

from roslens.judge.quality.quality_model import QualityModel
from roslens.model.finding import RuleInfo
from roslens.model.source import Package
from roslens.source.settings import SourceSettings
from roslens.source.workspace.silence import RULES, Nameable


def nameable_rules(
    settings: SourceSettings, models: Sequence[QualityModel], plugins: Iterable[RuleInfo]
) -> Callable[[Package], Nameable]:
    """Return a function that says it of a package; nothing is imported before it is asked."""

    def nameable(package: Package) -> Nameable:
        from roslens.judge.quality.quality_model import rules_of
        from roslens.source.rules.graph.findings import RULES as GRAPH
        from roslens.source.rules.selection import selected
        from roslens.source.rules.table import native_rules
        from roslens.source.tools.used import TOOLS

        native = native_rules()
        others = (*plugins, *(rule for model in models for rule in rules_of(model)), *RULES)
        known = (*others, *(rule.info for rule in native.values()), *(rule for rule, _ in GRAPH))
        ran = {rule.id for rule in others} | selected(settings.rules, package, native).keys()
        return Nameable(known, frozenset(ran), frozenset((*TOOLS, *settings.tools.commands)))

    return nameable
