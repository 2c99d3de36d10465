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
MANY = "one of many strings"
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
    for hole in text.holes:
        for choice in hole.choice:
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
        match part:
            case Hole(reason=OfMany() as reason):
                return reason
            case Hole(parameter=parameter) if parameter:
                parameters[parameter] = None
            case str() if part.strip("~/"):
                shown[part] = None
    words = f"{MANY}, by {str(condition)[:_MOST_LENGTH]}"
    if parameters:
        words += f" and parameters {_some(list(parameters))}"
    return OfMany(f"{words}; among their parts: {_some(list(shown))}" if shown else words)


def _parts(texts: tuple[Text, ...]) -> Iterator[str | Hole]:
    for text in texts:
        for part in text.parts:
            match part:
                case Hole(choice=(choice, *_)):
                    yield from _parts((choice.then, choice.otherwise))
                case _:
                    yield part


def _some(names: list[str]) -> str:
    more = ", …" if len(names) > _MOST_SHOWN else ""
    return ", ".join(name[:_MOST_LENGTH] for name in names[:_MOST_SHOWN]) + more
