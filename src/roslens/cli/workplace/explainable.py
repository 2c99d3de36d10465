"""What can be explained: quality models, quantities and rules, those of plug-ins too."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from roslens.cli.workplace.configuration import Configuration
    from roslens.judge.quality.quality_model import QualityModel
    from roslens.model.finding import RuleInfo
    from roslens.model.quantity import Quantity

Known = tuple["dict[str, QualityModel]", "dict[str, Quantity]", "dict[str, RuleInfo]"]
"""Models by name, quantities by key and rules by id."""


def known(configuration: Configuration) -> Known:
    """Return what can be explained: of roslens, and of what the configuration of a workspace adds."""
    from roslens.judge.quality.quality_model import builtin_models, load_model, rules_of
    from roslens.source.forge.quantities import FORGE_QUANTITIES
    from roslens.source.history.metrics.table import PROCESS_QUANTITIES
    from roslens.source.metrics.table import QUANTITIES
    from roslens.source.plugin_stage import discover_plugins
    from roslens.source.rules.table import native_rules
    from roslens.source.tools.checks.tool_rules import mapped_rules
    from roslens.source.tools.running.layout import RULE as LAYOUT
    from roslens.source.workspace.silence import RULES

    found = discover_plugins(configuration.source, Path(configuration.base or "."), configurations=True)
    quantities = {**QUANTITIES, **PROCESS_QUANTITIES, **FORGE_QUANTITIES}
    rules: dict[str, RuleInfo] = {rule.id: rule.info for rule in native_rules().values()}
    rules.update({rule.id: rule for rule in (*RULES, LAYOUT, *mapped_rules())})
    for member in found.members:
        quantities.update({quantity.key: quantity for quantity in member.manifest.quantities})
        rules.update({rule.id: rule for rule in member.manifest.rules})
    models: dict[str, QualityModel] = {}
    for name in dict.fromkeys((*builtin_models(), *configuration.source.models)):
        model = load_model(name, quantities, base=Path(configuration.base or "."))
        models[model.name] = model
        rules.update({rule.id: rule for rule in rules_of(model)})
    return models, quantities, rules
