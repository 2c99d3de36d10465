"""Which tags ``--tag`` may name: a misspelt one would filter every finding out and pass for clean."""

from __future__ import annotations

import difflib
from typing import TYPE_CHECKING

from roslens.model.errors import UsageError

if TYPE_CHECKING:
    from roslens.cli.workplace.configuration import Configuration
    from roslens.model.tags import TagFilter
    from roslens.store.read import RunView


def refuse_unknown_tags(tags: TagFilter, view: RunView, configuration: Configuration) -> None:
    """Refuse a tag that no rule and no finding can have.

    Args:
        tags: the condition of the command line.
        view: the run; findings that were imported from other tools bring tags of their own.
        configuration: of the user, with models and plug-ins.

    Raises:
        UsageError: the condition names such a tag.
    """
    if not tags:
        return
    of_run = {tag.casefold() for rule in view.rules() for tag in rule.tags}
    of_run.update(tag.casefold() for package in view.packages() for count in package.rules for tag in count.tags)
    unknown = [name for name in tags.names if name not in of_run]
    if not unknown:
        return
    known = of_run | _of_all_rules(configuration)
    for name in unknown:
        if name not in known:
            near = difflib.get_close_matches(name, known, 1)
            raise UsageError(
                f"--tag: no rule has the tag {name!r}",
                expected="tags of rules, models or profiles, such as complexity, node or ros2",
                advice=f"Did you mean {near[0]}?" if near else "`roslens explain RULE` shows the tags of a rule",
            )


def _of_all_rules(configuration: Configuration) -> set[str]:
    """Return the tags of all rules, of those that are off here too: nothing can be wrong with naming these."""
    from roslens.cli.workplace.explainable import known
    from roslens.source.rules.graph.findings import RULES
    from roslens.source.rules.profiles import PROFILES

    _, _, rules = known(configuration)
    found = {tag.casefold() for rule in (*rules.values(), *(rule for rule, _ in RULES)) for tag in rule.tags}
    return found | {name.casefold() for name in PROFILES}
