"""Texts that are one of so many that nobody would read them all: one unknown part that says what decides and may stand.

Choices in choices double with each level: what a program computes of its arguments in some calls of one another is soon
one of hundreds. No configuration tells so many alternatives apart; what is known of them is said in words.
"""

from __future__ import annotations

from collections.abc import Iterator

from roslens.source.extract.symbolic.reason import OfMany
from roslens.source.extract.symbolic.text import Condition, Hole, Text

MOST_WAYS = 16
"""Ways through the conditions of one text that are kept apart."""
MANY = "one of many texts"
_MOST_SHOWN = 4
_MOST_LENGTH = 60


def of_many(condition: Condition, *texts: Text) -> Text | None:
    """Return an unknown text in place of texts of which a condition chooses; None where few enough may stand there.

    It has no choice and no deciding parameter: nothing that is set makes it known.
    """
    ways = MOST_WAYS
    for text in texts:
        ways -= _ways(text, ways)
        if ways < 0:
            return Text((Hole(_reason(condition, texts)),))
    return None


def _ways(text: Text, most: int) -> int:
    """Return how many texts it may be, or any number above ``most`` where it is more."""
    found = 0
    for part in text.parts:
        if isinstance(part, Hole):
            for choice in part.choice:
                found += _ways(choice.then, most - found)
                if found <= most:
                    found += _ways(choice.otherwise, most - found)
                if found > most:
                    return found
    return found or 1


def _reason(condition: Condition, texts: tuple[Text, ...]) -> OfMany:
    shown: dict[str, None] = {}
    parameters: dict[str, None] = {}
    for part in _parts(texts):
        if isinstance(part, Hole):
            if isinstance(part.reason, OfMany):
                return part.reason
            if part.parameter:
                parameters[part.parameter] = None
        elif part.strip("~/"):
            shown[part] = None
    reason = f"{MANY}, by {str(condition)[:_MOST_LENGTH]}"
    if parameters:
        reason += f" and parameters {_some(list(parameters))}"
    return OfMany(f"{reason}; among their parts: {_some(list(shown))}" if shown else reason)


def _parts(texts: tuple[Text, ...]) -> Iterator[str | Hole]:
    for text in texts:
        for part in text.parts:
            for choice in part.choice if isinstance(part, Hole) else ():
                yield from _parts((choice.then, choice.otherwise))
            if isinstance(part, str) or not part.choice:
                yield part


def _some(names: list[str]) -> str:
    more = ", …" if len(names) > _MOST_SHOWN else ""
    return ", ".join(name[:_MOST_LENGTH] for name in names[:_MOST_SHOWN]) + more
