"""Merges the reactions of reference documents: all of them hold, unless one replaces another in so many words."""

from __future__ import annotations

from collections.abc import Sequence

import msgspec

from roslens.judge.reference.reaction_fights import refuse_fights
from roslens.judge.reference.reference_document import ReferenceDocument
from roslens.model.acting.reaction import Reaction
from roslens.model.errors import DocumentError
from roslens.plugins.nearest import did_you_mean


def merge_reactions(documents: Sequence[ReferenceDocument]) -> tuple[Reaction, ...]:
    """Return what holds of the reactions of documents, later ones taking precedence where they override.

    Raises:
        DocumentError: one has the name of another, overrides none or several, or two documents fight over one entity.
    """
    kept: dict[str, Reaction] = {}
    for document in documents:
        earlier = tuple(kept)
        for one in document.reactions:
            name = one.reaction.name
            if one.override:
                name = _overridden(earlier, one.name, one.reaction)
                # A replaced reaction keeps its name, as others may refer to that.
                kept[name] = msgspec.structs.replace(one.reaction, name=name)
            elif name not in kept:
                kept[name] = one.reaction
            elif one.reaction != kept[name]:
                raise DocumentError(
                    f"a second reaction {name!r}",
                    where=one.reaction.place,
                    expected=f"one (the first is at {kept[name].place})",
                )
    found = tuple(kept[name] for name in sorted(kept))
    refuse_fights(found)
    return found


def _overridden(earlier: Sequence[str], words: str, one: Reaction) -> str:
    targets = [name for name in earlier if words in (name, name.partition(".")[2])]
    if len(targets) == 1:
        return targets[0]
    if targets:
        raise DocumentError(
            f"id {words!r} of several reactions to override", where=one.place, expected=f"one of {', '.join(targets)}"
        )
    raise DocumentError(
        f"nothing to override: no reaction {words!r} in an earlier document",
        where=one.place,
        expected="the id of a reaction that is included or given before",
        advice=did_you_mean(words, [name.partition(".")[2] for name in earlier]),
    )
