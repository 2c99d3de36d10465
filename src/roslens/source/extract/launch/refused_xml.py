"""XML that no reader takes: where it breaks, with the element that is open there.

launch reads its files with ElementTree from text in UTF-8, roslaunch with minidom from bytes; both are expat.
"""

from __future__ import annotations

from typing import NoReturn
from xml.parsers import expat

from roslens.source.extract.facts.refusal import Refusal

_MISMATCH = 7
MOST_LEVELS = 1_000
"""Of elements: launch and roslaunch visit them by calls of Python, which ends with a RecursionError before that."""
_UNCLOSED = frozenset({3, 5, 20})


class _Stopped(Exception):  # noqa: N818 - no error: what follows is not judged
    pass


def refused_xml(content: bytes, *, in_utf8: bool) -> Refusal | None:
    """Return where XML is not well-formed; None where it is, or where it declares entities.

    Args:
        content: of the file.
        in_utf8: whether the reader takes it for UTF-8, whatever it declares.
    """
    if in_utf8:
        try:
            content.decode("utf-8")
        except UnicodeDecodeError as error:
            line, column = _place(content, error.start)
            return Refusal(line, column, f"the byte 0x{content[error.start]:02x}, which is not UTF-8", "text in UTF-8")
    return _Reading(content, "utf-8" if in_utf8 else None).run()


class _Reading:
    def __init__(self, content: bytes, encoding: str | None) -> None:
        self._content = content
        self._open: list[tuple[str, int]] = []
        self._too_deep: Refusal | None = None
        self._parser = parser = expat.ParserCreate(encoding)
        parser.StartElementHandler = self._start
        parser.EndElementHandler = self._end
        parser.EntityDeclHandler = self._entity

    def run(self) -> Refusal | None:
        try:
            self._parser.Parse(self._content, True)
        except _Stopped:
            return None
        except expat.ExpatError as error:
            return self._refusal(error)
        except (LookupError, ValueError) as error:
            return Refusal(1, 1, str(error), "an encoding that Python knows, such as UTF-8")
        return self._too_deep

    def _start(self, tag: str, _attributes: dict[str, str]) -> None:
        if len(self._open) == MOST_LEVELS and self._too_deep is None:
            line, column = self._parser.CurrentLineNumber, self._parser.CurrentColumnNumber + 1
            self._too_deep = Refusal(line, column, f"more than {MOST_LEVELS:,} levels of elements", "fewer levels")
        self._open.append((tag, self._parser.CurrentLineNumber))

    def _end(self, _tag: str) -> None:
        self._open.pop()

    def _entity(self, *_rest: object) -> NoReturn:
        raise _Stopped

    def _refusal(self, error: expat.ExpatError) -> Refusal:
        offset = max(0, self._parser.ErrorByteIndex)
        line, column = _place(self._content, offset)
        reason = expat.ErrorString(error.code) or str(error)
        found = self._content[offset : offset + 60].splitlines()[:1]
        shown = found[0].decode("utf-8", "replace").strip() if found else ""
        if error.code == _MISMATCH and self._open:
            tag, opened = self._open[-1]
            closing = shown.partition(">")[0].removeprefix("</").strip()
            what = f"</{closing}> where <{tag}> of line {opened} is open"
            return Refusal(line, column, f"{what} ({reason})", f"</{tag}>")
        if error.code in _UNCLOSED and self._open:
            tag, opened = self._open[-1]
            return Refusal(line, column, f"<{tag}> of line {opened} is never closed ({reason})", f"</{tag}>")
        quoted = f" at {shown[:40]!r}" if shown else ""
        return Refusal(line, column, f"{reason}{quoted}", self._hint(offset) or "well-formed XML")

    def _hint(self, offset: int) -> str:
        """Return what is expected where a common slip stands before the place at which the reader gave up."""
        start = self._content.rfind(b"\n", 0, offset) + 1
        before, after = self._content[start:offset], self._content[offset : offset + 4]
        comment = self._content.rfind(b"<!--", 0, offset)
        if comment >= 0 and self._content.find(b"-->", comment, offset) < 0:
            return "a comment without `--` in it"
        if before.rstrip().endswith(b"&") or after.startswith(b"&") or b"&" in before[-20:]:
            return "`&amp;` for `&`"
        if after.startswith(b"<") and before.count(b'"') % 2:
            return "`&lt;` for `<` in an attribute"
        return ""


def _place(content: bytes, offset: int) -> tuple[int, int]:
    start = content.rfind(b"\n", 0, offset) + 1
    return content.count(b"\n", 0, offset) + 1, len(content[start:offset].decode("utf-8", "replace")) + 1
