"""The arguments of a node of ROS 1 as words: roslaunch makes the substitutions first, then splits as a shell does."""

from __future__ import annotations

from roslens.source.extract.symbolic.text import Hole, Text

_QUOTES = "'\""


def words_of(text: Text) -> tuple[Text, ...]:
    """Return the words of a text, as :func:`shlex.split` has them; what is unknown is part of a word.

    A quotation that never ends, which roslaunch refuses, ends with the text.
    """
    words: list[Text] = []
    word: list[str | Hole] = []
    quote, escaped, begun = "", False, False
    for sign in _signs(text):
        match sign:
            case Hole():
                word.append(sign)
                begun = True
                continue
        if escaped:
            # Within quotes a backslash is one, but before the quote and another backslash.
            word.append(sign if not quote or sign in (quote, "\\") else f"\\{sign}")
            escaped = False
        elif sign == "\\" and quote != "'":
            escaped = begun = True
        elif quote:
            if sign == quote:
                quote = ""
            else:
                word.append(sign)
        elif sign in _QUOTES:
            quote, begun = sign, True
        elif sign in " \t\r\n":
            words += [Text.of(*word)] if begun else []
            word, begun = [], False
        else:
            word.append(sign)
            begun = True
    return (*words, Text.of(*word)) if begun else tuple(words)


def _signs(text: Text) -> list[str | Hole]:
    found: list[str | Hole] = []
    for part in text.parts:
        match part:
            case str():
                found += part
            case _:
                found.append(part)
    return found
