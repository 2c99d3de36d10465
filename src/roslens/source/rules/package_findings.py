"""All findings of native rules in a package: what its files were found to have, and what rules on packages find."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import suppress
from itertools import islice

from roslens.intake.file_budget import file_budget
from roslens.intake.time_budget import SOURCE_FILE_S, OverBudgetError
from roslens.model.entity import Entity, EntityId, EntityKind
from roslens.model.failure import Failure
from roslens.model.finding import Finding
from roslens.model.source import OUTSIDE_PACKAGES
from roslens.source.over_budget import in_rules
from roslens.source.rules.by_package.caught_type import as_notes_of_caught_types
from roslens.source.rules.by_package.device_driver import as_notes_in_drivers
from roslens.source.rules.by_package.earlier_distribution import as_notes_for_earlier_distribution
from roslens.source.rules.by_package.for_target import as_the_target_has
from roslens.source.rules.by_package.launched_elsewhere import as_notes_where_launched_elsewhere
from roslens.source.rules.by_package.left_behind import as_notes_where_left_behind
from roslens.source.rules.by_package.named_by_launch import as_notes_where_launch_names
from roslens.source.rules.by_package.nested_package import as_notes_in_nested_package
from roslens.source.rules.by_package.older_standard import as_notes_with_older_standard
from roslens.source.rules.by_package.python2_package import as_notes_without_python3
from roslens.source.rules.by_package.unbuilt_source import as_notes_of_unbuilt_sources
from roslens.source.rules.by_package.uncalled_function import as_notes_where_uncalled
from roslens.source.rules.by_package.unstarted_file import as_notes_where_nothing_starts
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

Placed = dict[str, list[Hit]]

MOST_SPENT = 3
"""Rules on a package that may take too long; no further one is tried then."""


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
        _hold(view, [rule for rule in package_rules() if rule.id in selection], placed, failures)
    style = guard_style(settings.profiles, view.ros)
    placed = _with_edits(placed, view, style)
    for weighed in _WEIGHED:
        # What depends on a file that is left out is judged without it.
        with suppress(OverBudgetError), file_budget(_subject(weighed.__name__, view.package.id)):
            placed = weighed(placed, view)
    return place_hits(placed, callbacks, selection, rules, entities)


def _hold(view: PackageView, rules: Sequence[PackageRule], placed: Placed, failures: list[Failure]) -> None:
    """Hold rules against a package, and add what they find to ``placed``."""
    spent = 0
    for rule in rules:
        if spent >= MOST_SPENT:
            failures.extend(_unheld(rule, view, OverBudgetError(f"{spent} others took too long")))
            return
        try:
            with file_budget(_subject(rule.id, view.package.id)):
                for hit in islice(rule.found(view), MOST_HITS):
                    placed.setdefault(hit.path, []).append(hit)
        except OverBudgetError as error:
            spent += error.subject == _subject(rule.id, view.package.id)
            failures.extend(_unheld(rule, view, error))
        except Exception as error:  # noqa: BLE001 - a rule that breaks must not lose what the others find
            failures.append(_broken(rule, view, error))


def _left_behind(placed: Placed, view: PackageView) -> Placed:
    return as_notes_where_left_behind(placed, {path.rpartition("/")[2] for path in view.listing})


_WEIGHED: tuple[Callable[[Placed, PackageView], Placed], ...] = (
    as_the_target_has,
    as_notes_without_python3,
    as_notes_with_older_standard,
    as_notes_of_caught_types,
    as_notes_in_nested_package,
    as_notes_of_unused_scripts,
    _left_behind,
    as_notes_where_used_once,
    as_notes_of_unbuilt_sources,
    as_notes_for_earlier_distribution,
    as_notes_in_drivers,
    as_notes_where_launch_names,
    as_notes_where_uncalled,
    as_notes_where_launched_elsewhere,
    as_notes_where_nothing_starts,
)
"""What makes notes of hits for what the package is, in this order."""


def _with_edits(placed: Placed, view: PackageView, style: str) -> Placed:
    found: Placed = {}
    for path, hits in placed.items():
        found[path] = hits
        with suppress(OverBudgetError):
            found[path] = list(with_placed_edits(hits, path, view, style))
    return found


def _subject(rule: str, package: str) -> str:
    """Return what a rule at work on a package is called among files that take too long."""
    return f"rule {rule} in {package}"


def _unheld(rule: PackageRule, view: PackageView, error: OverBudgetError) -> Iterator[Failure]:
    """Yield the failure of a rule that was not held against a package; a file that is left out has its own."""
    if error.subject in view.by_path or error.subject == in_rules(view.package.manifest.path):
        return
    yield Failure(
        tool=TOOL,
        what=f"rule {rule.id} was not applied: {error}",
        expected=f"an answer within {SOURCE_FILE_S:g} s of processor time",
        advice="Look for a file of the package that is much larger than usual, or disable the rule",
        entity=str(EntityId(EntityKind.PACKAGE, view.package.id)),
        package=view.package.id,
        partial=True,
    )


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
