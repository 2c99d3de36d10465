"""Which native rules count for a package, and how much: profiles, then what the user turned on and off."""

from __future__ import annotations

from collections.abc import Mapping
from fnmatch import fnmatchcase

from roslens.model.errors import UsageError
from roslens.model.finding import Severity
from roslens.model.source import Package
from roslens.plugins.nearest import did_you_mean
from roslens.source.rules.profiles import AUTOMATIC, PROFILES, ROS1, ROS2, profiles_of
from roslens.source.rules.rule import Rule
from roslens.source.settings import RuleSettings

Selection = Mapping[str, Severity]
"""Severity of each rule that is on, by its id."""


def selected(settings: RuleSettings, package: Package, rules: Mapping[str, Rule]) -> Selection:
    """Return the rules that are on for a package, with the severity that their findings have."""
    chosen: set[str] = set()
    for name in settings.profiles:
        for profile in profiles_of(package) if name == AUTOMATIC else (name,):
            chosen.update(rule.id for rule in rules.values() if profile in rule.profiles)
    chosen.update(one for one in rules if _is_named(one, settings.enable))
    chosen = {one for one in chosen if not _is_named(one, settings.disable)}
    return {one: Severity(settings.severity.get(one, rules[one].severity.value)) for one in sorted(chosen)}


def wanted_rules(settings: RuleSettings, rules: Mapping[str, Rule]) -> frozenset[str]:
    """Return the ids of the rules that are on for any package: no other has to look at files."""
    automatic = (ROS2, ROS1)
    profiles = {one for name in settings.profiles for one in (automatic if name == AUTOMATIC else (name,))}
    on = {rule.id for rule in rules.values() if profiles & set(rule.profiles)}
    on.update(one for one in rules if _is_named(one, settings.enable))
    return frozenset(one for one in on if not _is_named(one, settings.disable))


def check_rule_settings(settings: RuleSettings, rules: Mapping[str, Rule]) -> None:
    """Refuse names that mean nothing, and rules that contradict each other.

    Raises:
        UsageError: a profile, a rule or a severity is unknown, or two rules that are on require opposites.
    """
    for name in settings.profiles:
        if name not in (AUTOMATIC, *PROFILES):
            raise UsageError(
                f"profile {name!r} is unknown",
                where="[rules] profiles",
                expected=", ".join((AUTOMATIC, *PROFILES)),
                advice=did_you_mean(name, PROFILES),
            )
    for key, names in (("enable", settings.enable), ("disable", settings.disable), ("severity", settings.severity)):
        for name in names:
            if not any(_is_named(one, (name,)) for one in rules):
                raise UsageError(
                    f"rule {name!r} is unknown",
                    where=f"[rules] {key}",
                    expected="the id of a native rule, or a pattern such as cpp.*: `roslens explain --list` has them",
                    advice=did_you_mean(name, rules),
                )
    for name, severity in settings.severity.items():
        if severity not in tuple(one.value for one in Severity):
            raise UsageError(
                f"severity {severity!r} of rule {name!r} is unknown",
                where="[rules] severity",
                expected=", ".join(one.value for one in Severity),
            )
    _check_contradictions(settings, rules)


def _check_contradictions(settings: RuleSettings, rules: Mapping[str, Rule]) -> None:
    named = [name for name in settings.profiles if name != AUTOMATIC]
    on = {one for one, rule in rules.items() if set(named) & set(rule.profiles)}
    on.update(one for one in rules if _is_named(one, settings.enable))
    on = {one for one in on if not _is_named(one, settings.disable)}
    for one in sorted(on):
        for other in rules[one].unlike:
            if other in on:
                raise UsageError(
                    f"rules {one!r} and {other!r} require the opposite of each other",
                    where="[rules]",
                    expected="one of the two",
                    advice=f'Add one of them to `disable`: disable = ["{other}"]',
                )


def _is_named(rule: str, names: tuple[str, ...]) -> bool:
    return any(rule == name or fnmatchcase(rule, name) for name in names)
