"""XML as elements that know where they stand; what comes before a fault is kept.

Expat is the one XML reader of the standard library that tells the byte of each event. It reads no external
entity here, and a document that declares an entity is refused, so that none can grow without bound.
"""

from __future__ import annotations

from bisect import bisect_right
from xml.parsers import expat

import msgspec

MAXIMUM_DEPTH = 64
"""Elements nested deeper than this are no manifest; the limit keeps whoever walks them from overflowing."""


class Element(msgspec.Struct):
    """An element with its bytes ``content[start:end]``; ``children`` are elements and texts in order."""

    tag: str
    attributes: dict[str, str]
    start: int
    end: int
    children: list[Element | str]

    def elements(self) -> list[Element]:
        """Return the child elements in order."""
        return [child for child in self.children if isinstance(child, Element)]

    def text(self) -> str:
        """Return the text directly inside, without the text of child elements, stripped."""
        if len(self.children) == 1 and isinstance(self.children[0], str):
            return self.children[0].strip(" \t\r\n")
        return "".join(child for child in self.children if isinstance(child, str)).strip(" \t\r\n")

    def full_text(self) -> str:
        """Return all text inside, child elements included; ``<br>`` ends a line."""
        if self.tag == "br":
            return "\n"
        return "".join(child if isinstance(child, str) else child.full_text() for child in self.children)

    def markup(self) -> str:
        """Return what is inside as XML, stripped."""
        return "".join(_escaped(c) if isinstance(c, str) else c.written() for c in self.children).strip(" \t\r\n")

    def written(self) -> str:
        """Return the element as XML."""
        attributes = "".join(f' {name}="{_escaped(value)}"' for name, value in self.attributes.items())
        if not self.children:
            return f"<{self.tag}{attributes}/>"
        inside = "".join(_escaped(c) if isinstance(c, str) else c.written() for c in self.children)
        return f"<{self.tag}{attributes}>{inside}</{self.tag}>"


class Fault(msgspec.Struct, frozen=True):
    """Why a document could not be read from byte ``offset`` on (or not as it claims to be)."""

    what: str
    offset: int
    expected: str
    advice: str


class Document(msgspec.Struct, frozen=True):
    """The root element, as far as it could be read, and what was wrong."""

    root: Element | None
    faults: tuple[Fault, ...]
    line_starts: tuple[int, ...]

    def place(self, offset: int) -> tuple[int, int]:
        """Return the 1-based line and column (in bytes) of a byte."""
        line = bisect_right(self.line_starts, offset)
        return line, offset - self.line_starts[line - 1] + 1


UNREAD = Document(None, (), (0,))
"""A document that is not read."""


def read_elements(content: bytes) -> Document:
    """Read a document; a fault ends the reading but what was read before it stays.

    Text that is not UTF-8, although it claims or has to be, is read as Latin-1 and reported as a fault; an encoding
    that expat does not know likewise.
    """
    faults: list[Fault] = []
    reading = _Reading(content, None)
    fault = reading.run()
    if fault is not None:
        other = _other_encoding(content, reading, fault)
        if other is not None:
            encoding, reason = other
            faults.append(reason)
            reading = _Reading(content, encoding)
            fault = reading.run()
    if fault is not None:
        faults.append(fault)
    return Document(reading.root, tuple(faults), _line_starts(content))


class _RefusedError(Exception):
    """Raised inside expat's callbacks to stop it."""

    def __init__(self, fault: Fault) -> None:
        super().__init__(fault.what)
        self.fault = fault


class _Reading:
    """One pass of expat over the content."""

    def __init__(self, content: bytes, encoding: str | None) -> None:
        self.content = content
        self.root: Element | None = None
        self.unknown_encoding = False
        self.declared = ""
        self._open: list[Element] = []
        parser = expat.ParserCreate(encoding)
        parser.buffer_text = True
        parser.XmlDeclHandler = self._declaration
        parser.StartElementHandler = self._start
        parser.EndElementHandler = self._end
        parser.CharacterDataHandler = self._text
        parser.EntityDeclHandler = self._entity
        self._parser = parser

    def run(self) -> Fault | None:
        try:
            self._parser.Parse(self.content, True)
        except _RefusedError as refused:
            self._close_all(refused.fault.offset)
            return refused.fault
        except expat.ExpatError as error:
            offset = max(0, self._parser.ErrorByteIndex)
            self._close_all(offset)
            if error.code == _UNKNOWN_ENCODING:
                self.unknown_encoding = True
                return Fault(f'the encoding "{self.declared}" is unknown or multi-byte', 0, "", "")
            return _broken(self.content, expat.ErrorString(error.code) or str(error), offset)
        except (LookupError, ValueError):
            self._close_all(0)
            self.unknown_encoding = True
            return Fault(f'the encoding "{self.declared}" is unknown or multi-byte', 0, "", "")
        return None

    def _declaration(self, _version: str, encoding: str | None, _standalone: int) -> None:
        self.declared = encoding or ""

    def _start(self, tag: str, attributes: dict[str, str]) -> None:
        start = self._parser.CurrentByteIndex
        if len(self._open) >= MAXIMUM_DEPTH:
            raise _RefusedError(
                Fault(
                    f'"<{tag}>" is nested deeper than {MAXIMUM_DEPTH} elements',
                    start,
                    "a manifest, which is flat",
                    "Close the elements around it.",
                )
            )
        element = Element(tag, attributes, start, start, [])
        if self._open:
            self._open[-1].children.append(element)
        elif self.root is None:
            self.root = element
        self._open.append(element)

    def _end(self, _tag: str) -> None:
        element = self._open.pop()
        index = self._parser.CurrentByteIndex
        empty = not element.children and self.content[index - 2 : index] == b"/>"
        element.end = index if empty else self.content.find(b">", index) + 1

    def _text(self, text: str) -> None:
        self._open[-1].children.append(text)

    def _entity(self, name: str, *_rest: object) -> None:
        raise _RefusedError(
            Fault(
                f'the document declares an entity "{name}"',
                max(0, self._parser.CurrentByteIndex),
                "no entity declarations, which can grow without bound",
                "Write the text itself instead of the entity.",
            )
        )

    def _close_all(self, offset: int) -> None:
        for element in self._open:
            element.end = max(offset, element.start)
        self._open.clear()


_UNKNOWN_ENCODING = 18


def _other_encoding(content: bytes, reading: _Reading, fault: Fault) -> tuple[str, Fault] | None:
    """Return the encoding to try instead and why, or nothing where the fault is not about encoding."""
    try:
        content.decode("utf-8")
        bad = -1
    except UnicodeDecodeError as error:
        bad = error.start
    if reading.unknown_encoding:
        fallback = "Latin-1" if bad >= 0 else "UTF-8"
        advice = f"Save the file as UTF-8; it was read as {fallback}."
        return ("iso-8859-1" if bad >= 0 else "utf-8"), Fault(
            fault.what, 0, "an encoding that XML readers know", advice
        )
    if bad < 0 or content[:2] in (b"\xff\xfe", b"\xfe\xff") or reading.declared.lower() not in ("", "utf-8"):
        return None
    what = f'the byte "0x{content[bad]:02X}" is not UTF-8'
    advice = "Save the file as UTF-8; it was read as Latin-1."
    return "iso-8859-1", Fault(what, bad, "UTF-8 or a declared encoding", advice)


def _broken(content: bytes, reason: str, offset: int) -> Fault:
    line = content[offset : offset + 40].splitlines()[:1]
    found = line[0].decode("utf-8", "replace").replace("\0", "\N{SYMBOL FOR NULL}").strip() if line else ""
    what = f'broken XML, {reason}, at "{found}"' if found else f"broken XML, {reason}"
    return Fault(what, offset, "well-formed XML", "Correct it; everything before it was read.")


def _line_starts(content: bytes) -> tuple[int, ...]:
    starts = [0]
    at = content.find(b"\n")
    while at >= 0:
        starts.append(at + 1)
        at = content.find(b"\n", at + 1)
    return tuple(starts)


_ESCAPES = str.maketrans({"&": "&amp;", "<": "&lt;", ">": "&gt;", '"': "&quot;"})


def _escaped(text: str) -> str:
    return text.translate(_ESCAPES)
