"""Rules of foreign tools that a run describes: those that its findings name."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence

from roslens.model.finding import RuleInfo
from roslens.source.tools.checks.tool_checks import checks_of, rule_of
from roslens.source.tools.used import TOOLS


def seen_rules(seen: Iterable[str], tools: Sequence[str], imported: Mapping[str, RuleInfo]) -> tuple[RuleInfo, ...]:
    """Return the rules of ``tools`` and those that were ``imported`` among ids of rules, sorted."""
    found = []
    for identity in sorted(set(seen)):
        tool, dot, check = identity.partition(".")
        if identity in imported:
            found.append(imported[identity])
        elif dot and tool in tools:
            found.append(rule_of(tool, check))
    return tuple(found)


def mapped_rules() -> tuple[RuleInfo, ...]:
    """Return the rules of all tools that data files name one by one."""
    return tuple(rule_of(tool, check) for tool in TOOLS for check in sorted(checks_of(tool).checks))
