"""Text on a terminal: how wide it is, how it is cut, coloured and made harmless."""

from __future__ import annotations

import unicodedata

import msgspec

_UNICODE = {
    "error": "✖",
    "warning": "▲",
    "note": "●",
    "failed": "✖",
    "partly": "◐",
    "fine": "✔",
    "high": "▲",
    "none": "\N{EN DASH}",
    "zero": "·",
    "cut": "…",
    "dot": "·",
}
_ASCII = {
    "error": "x",
    "warning": "!",
    "note": "*",
    "failed": "x",
    "partly": "~",
    "fine": "+",
    "high": "!",
    "none": "-",
    "zero": ".",
    "cut": "...",
    "dot": "|",
}
_COLORS = {
    "error": "1;31",
    "failed": "1;31",
    "warning": "33",
    "partly": "33",
    "high": "33",
    "note": "36",
    "fine": "32",
    "title": "1",
    "quiet": "2",
}
# Codes that reorder what is read, so that source can look like other source (CVE-2021-42574).
_REORDER = frozenset("\u200e\u200f\u202a\u202b\u202c\u202d\u202e\u2066\u2067\u2068\u2069")


class Terminal(msgspec.Struct, frozen=True):
    """What the reader's terminal can show. ``width`` is in columns."""

    width: int
    color: bool
    unicode: bool

    def glyph(self, name: str) -> str:
        """Return the sign for a severity, a state or an abbreviation."""
        return (_UNICODE if self.unicode else _ASCII)[name]

    def paint(self, text: str, role: str) -> str:
        """Return the text in the colour of its role; the words say the same without."""
        return f"\x1b[{_COLORS[role]}m{text}\x1b[0m" if self.color and text else text

    def clean(self, text: str) -> str:
        """Return text from elsewhere on one line, with nothing in it that a terminal would obey or cannot show."""
        if text.isascii() and text.isprintable():
            return text
        shown = "".join(map(_harmless, " ".join(text.split())))
        return shown if self.unicode else shown.encode("ascii", "backslashreplace").decode()

    def cut(self, text: str, width: int) -> str:
        """Return as much of the text as fits into ``width`` columns, with a sign where something is missing."""
        if columns(text) <= width:
            return text
        sign = self.glyph("cut")
        room = width - len(sign)
        if room <= 0:
            return sign[: max(0, width)]
        kept = ""
        for character in text:
            room -= columns(character)
            if room < 0:
                break
            kept += character
        return kept.rstrip() + sign

    def shorten(self, text: str, width: int) -> str:
        """Return as many words of the text as fit into ``width`` columns, with a sign where something is missing.

        Code between back-ticks is kept whole or left out; a first word that is too long is cut.
        """
        if columns(text) <= width:
            return text
        kept, end = self.cut(text, width), 0
        for place in range(len(kept) - len(self.glyph("cut"))):
            if text[place] == " " and text.count("`", 0, place) % 2 == 0:
                end = place
        return f"{text[:end].rstrip(' ,;:')} {self.glyph('cut')}" if end else kept

    def wrap(self, text: str, indent: str, *, lines: int = 3) -> list[str]:
        """Return the text in at most ``lines`` indented lines that fit the terminal."""
        room = max(20, self.width - len(indent))
        wrapped: list[str] = []
        rest = text
        while rest and len(wrapped) < lines - 1:
            line, rest = _first_line(rest, room)
            wrapped.append(line)
        if rest:
            wrapped.append(self.shorten(rest, room))
        return [indent + line for line in wrapped]


def _first_line(text: str, room: int) -> tuple[str, str]:
    """Return what of the text fits into ``room`` columns, cut between words if there are any, and the rest."""
    end = taken = 0
    for end, character in enumerate(text):  # noqa: B007 - where it stopped is what is wanted
        taken += columns(character)
        if taken > room:
            break
    else:
        return text, ""
    space = text.rfind(" ", 0, end + 1)
    cut = space if space > 0 else end
    return text[:cut].rstrip(), text[cut:].lstrip()


def columns(text: str) -> int:
    """Return how many columns of a terminal the text takes."""
    if text.isascii():
        return len(text)
    return sum(_columns_of(character) for character in text)


def left(text: str, width: int) -> str:
    """Return the text with blanks behind it, ``width`` columns in all."""
    return text + " " * (width - columns(text))


def right(text: str, width: int) -> str:
    """Return the text with blanks in front of it, ``width`` columns in all."""
    return " " * (width - columns(text)) + text


def printable(line: str) -> str:
    """Return a line in which nothing is left that a terminal would obey; names come from the source that is read."""
    if line.isprintable():
        return line
    return "".join(sign if sign.isprintable() else sign.encode("unicode_escape").decode() for sign in line)


def _columns_of(character: str) -> int:
    if unicodedata.combining(character) or unicodedata.category(character) in {"Mn", "Me", "Cf"}:
        return 0
    return 2 if unicodedata.east_asian_width(character) in "WF" else 1


def _harmless(character: str) -> str:
    if character in _REORDER or unicodedata.category(character) in {"Cc", "Cs", "Zl", "Zp"}:
        code = ord(character)
        return f"\\x{code:02x}" if code < 0x100 else f"\\u{code:04x}"
    return character
