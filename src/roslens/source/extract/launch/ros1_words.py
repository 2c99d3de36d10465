"""The arguments of a node of ROS 1 as words: roslaunch makes the substitutions first, then splits as a shell does."""

from __future__ import annotations

from roslens.source.extract.symbolic.text import Hole, Text

_QUOTES = "'\""
_SPACE = " \t\r\n"


def words_of(text: Text) -> tuple[Text, ...]:
    """Return the words of a text, as :func:`shlex.split` has them; what is unknown is part of a word.

    A quotation that never ends, which roslaunch rejects, ends with the text.
    """
    reading = _Words()
    for sign in _signs(text):
        match sign:
            case Hole():
                reading.add(sign)
            case _:
                reading.take(sign)
    reading.end()
    return tuple(reading.words)


class _Words:
    """The words of a text, as far as its signs have come."""

    def __init__(self) -> None:
        self.words: list[Text] = []
        self._word: list[str | Hole] = []
        self._quote = ""
        self._escaped = self._begun = False

    def take(self, sign: str) -> None:
        """Go on by one sign."""
        if self._escaped:
            # Within quotes a backslash is one, but before the quote and another backslash.
            self.add(sign if not self._quote or sign in (self._quote, "\\") else f"\\{sign}")
            self._escaped = False
        elif sign == "\\" and self._quote != "'":
            self._escaped = self._begun = True
        elif sign == self._quote:
            self._quote = ""
        elif self._quote:
            self.add(sign)
        elif sign in _QUOTES:
            self._quote, self._begun = sign, True
        elif sign in _SPACE:
            self.end()
        else:
            self.add(sign)

    def add(self, piece: str | Hole) -> None:
        """Go on with the word by a sign or by what is unknown."""
        self._word.append(piece)
        self._begun = True

    def end(self) -> None:
        """End the word, if there is one."""
        if self._begun:
            self.words.append(Text.of(*self._word))
        self._word, self._begun = [], False


def _signs(text: Text) -> list[str | Hole]:
    found: list[str | Hole] = []
    for part in text.parts:
        match part:
            case str():
                found += part
            case _:
                found.append(part)
    return found
