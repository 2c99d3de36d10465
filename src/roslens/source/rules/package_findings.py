"""All findings of native rules in a package: what its files were found to have, and what rules on packages find."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from itertools import islice

from roslens.model.entity import Entity, EntityId, EntityKind
from roslens.model.failure import Failure
from roslens.model.finding import Finding
from roslens.model.source import OUTSIDE_PACKAGES
from roslens.source.rules.by_package.caught_type import as_notes_of_caught_types
from roslens.source.rules.by_package.for_target import as_the_target_has
from roslens.source.rules.by_package.left_behind import as_notes_where_left_behind
from roslens.source.rules.by_package.named_by_launch import as_notes_where_launch_names
from roslens.source.rules.by_package.nested_package import as_notes_in_nested_package
from roslens.source.rules.by_package.older_standard import as_notes_with_older_standard
from roslens.source.rules.by_package.python2_package import as_notes_without_python3
from roslens.source.rules.by_package.unbuilt_source import as_notes_of_unbuilt_sources
from roslens.source.rules.by_package.uncalled_function import as_notes_where_uncalled
from roslens.source.rules.by_package.unused_script import as_notes_of_unused_scripts
from roslens.source.rules.by_package.used_once import as_notes_where_used_once
from roslens.source.rules.edits.placed_edits import with_placed_edits
from roslens.source.rules.guard_style import guard_style
from roslens.source.rules.hit import Hit
from roslens.source.rules.match_file import MOST_HITS
from roslens.source.rules.package_view import PackageView
from roslens.source.rules.place_hits import place_hits
from roslens.source.rules.rule import TOOL, PackageRule
from roslens.source.rules.selection import selected
from roslens.source.rules.table import native_rules, package_rules
from roslens.source.settings import RuleSettings


def rule_findings(
    view: PackageView,
    settings: RuleSettings,
    hits: Mapping[str, Iterable[Hit]],
    callbacks: Iterable[str],
    entities: Sequence[Entity],
    failures: list[Failure],
) -> tuple[Finding, ...]:
    """Return what native rules find in a package and its files.

    Args:
        view: the package.
        settings: which rules are on.
        hits: of rules on files, by path.
        callbacks: names of the functions that files of the package register.
        entities: of the package, measured.
        failures: is added to where a rule breaks; the others stand.
    """
    rules = native_rules()
    selection = selected(settings, view.package, rules)
    placed: dict[str, list[Hit]] = {path: list(found) for path, found in hits.items() if found}
    if view.package.id != OUTSIDE_PACKAGES:
        for rule in package_rules():
            if rule.id not in selection:
                continue
            try:
                for hit in islice(rule.found(view), MOST_HITS):
                    placed.setdefault(hit.path, []).append(hit)
            except Exception as error:  # noqa: BLE001 - a rule that breaks must not lose what the others find
                failures.append(_broken(rule, view, error))
    style = guard_style(settings.profiles, view.ros)
    placed = {path: list(with_placed_edits(found, path, view, style)) for path, found in placed.items()}
    placed = as_the_target_has(placed, view)
    placed = as_notes_with_older_standard(as_notes_without_python3(placed, view), view)
    placed = as_notes_in_nested_package(as_notes_of_caught_types(placed, view), view)
    names = {path.rpartition("/")[2] for path in view.listing}
    placed = as_notes_where_left_behind(as_notes_of_unused_scripts(placed, view), names)
    placed = as_notes_of_unbuilt_sources(as_notes_where_used_once(placed, view), view)
    placed = as_notes_where_uncalled(as_notes_where_launch_names(placed, view), view)
    return place_hits(placed, callbacks, selection, rules, entities)


def _broken(rule: PackageRule, view: PackageView, error: Exception) -> Failure:
    import traceback

    return Failure(
        tool=TOOL,
        what=f"rule {rule.id} failed: {type(error).__name__}: {error}",
        expected="findings of this rule, or none",
        advice="Please report it with the package: this is a bug in roslens",
        entity=str(EntityId(EntityKind.PACKAGE, view.package.id)),
        package=view.package.id,
        detail="".join(traceback.format_exception(error)),
        partial=True,
    )
