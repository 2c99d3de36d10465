"""Text of source in a message: cut between words, with a sign where something is missing."""

from __future__ import annotations

import re

CUT = "…"
_WORD = re.compile(r"\w+|\W")


def shortened(text: str, most: int) -> str:
    """Return text of at most ``most`` characters, cut in front of the word that does not fit."""
    if len(text) <= most:
        return text
    end = 0
    for word in _WORD.finditer(text):
        if word.end() > most - len(CUT):
            break
        end = word.end()
    # A single word that is too long is still told by its beginning.
    return f"{text[: end or most - len(CUT)].rstrip()}{CUT}"


def visible(name: str) -> str:
    """Return a name in back-ticks, and in words that it begins or ends with blanks."""
    ends = [word for word, blank in (("begins", name != name.lstrip()), ("ends", name != name.rstrip())) if blank]
    return f"`{name}`" + (f" ({' and '.join(ends)} with a blank)" if ends else "")
