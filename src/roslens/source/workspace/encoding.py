"""In which encoding a source file is, and what is odd about its bytes.

Analysers work on bytes and get on with any of this; what they could not read properly has to be reported.
"""

from __future__ import annotations

import msgspec

from roslens.model.failure import Failure
from roslens.model.source import Location
from roslens.model.words.plural import plural

_UTF8_BOM = b"\xef\xbb\xbf"
_UTF16_BOMS = (b"\xff\xfe", b"\xfe\xff")
_BINARY_SHARE = 0.1


class Encoding(msgspec.Struct, frozen=True, omit_defaults=True):
    """``name`` is ``ascii``, ``utf-8``, ``latin-1`` (anything in single bytes), ``utf-16`` or ``binary``.

    ``odd_line`` and ``odd_column`` (in bytes) are the first place that is not UTF-8 or is a zero byte, 0 if none.
    """

    name: str
    bom: bool = False
    crlf: bool = False
    zero_bytes: int = 0
    odd_line: int = 0
    odd_column: int = 0


def encoding_of(content: bytes) -> Encoding:
    """Return how the bytes of a file are to be read."""
    crlf = b"\r\n" in content
    if content.startswith(_UTF16_BOMS):
        return Encoding("utf-16", bom=True, crlf=crlf, odd_line=1, odd_column=1)
    bom = content.startswith(_UTF8_BOM)
    zeros = content.count(b"\0")
    name, bad = _decoded(content)
    odd = min((at for at in (bad, content.find(b"\0")) if at >= 0), default=-1)
    if zeros > _BINARY_SHARE * len(content):
        name = "binary"
    if odd < 0:
        return Encoding(name, bom, crlf)
    line = content.count(b"\n", 0, odd) + 1
    column = odd - content.rfind(b"\n", 0, odd)
    return Encoding(name, bom, crlf, zeros, line, column)


def encoding_failure(path: str, content: bytes) -> Failure | None:
    """Return what has to be reported about the bytes of a source file; nothing for ASCII, UTF-8 and Latin-1.

    Latin-1 is analysed as well as UTF-8. A file with some zero bytes is still analysed; one that is UTF-16 or binary
    cannot be.
    """
    if content.isascii() and b"\0" not in content:
        return None
    encoding = encoding_of(content)
    where = Location(path, encoding.odd_line, encoding.odd_column)
    entity = f"file:{path}"
    if encoding.name == "utf-16":
        advice = "Save the file as UTF-8."
        return Failure("workspace", "the file is UTF-16", "source in UTF-8", advice, where, entity)
    if encoding.name == "binary":
        what = f"the file is binary, {encoding.zero_bytes} of {len(content)} bytes are zero"
        advice = "Rename it, or add it to `ignore` below [workspace] in roslens.toml."
        return Failure("workspace", what, "source text", advice, where, entity)
    if encoding.zero_bytes:
        what = f"the file contains {plural(encoding.zero_bytes, 'zero byte')}"
        advice = "Remove them; the rest of the file was analysed."
        return Failure("workspace", what, "source text", advice, where, entity, partial=True)
    return None


def _decoded(content: bytes) -> tuple[str, int]:
    """Return the encoding by what decodes, and the first byte that is not UTF-8 or -1."""
    if content.isascii():
        return "ascii", -1
    try:
        content.decode("utf-8")
    except UnicodeDecodeError as error:
        return "latin-1", error.start
    return "utf-8", -1
