"""A file's bytes with edits made: its line ends, its byte order mark and its encoding stay as they are."""

from __future__ import annotations

from collections.abc import Iterable

from roslens.model.edit import Edit

_MARK = b"\xef\xbb\xbf"


class EditError(ValueError):
    """Edits that cannot be made; the text states the reason."""


def edited(content: bytes, edits: Iterable[Edit]) -> bytes:
    """Return the content with edits made that do not overlap; several at one place in the order of their texts.

    Raises:
        EditError: an edit is of another content, or its text cannot be written in the file's encoding.
    """
    crlf = content.count(b"\r\n") * 2 > content.count(b"\n")
    parts: list[bytes] = []
    reached = 0
    for edit in sorted(set(edits), key=lambda one: (one.start, one.end, one.text)):
        start = max(edit.start, len(_MARK)) if content.startswith(_MARK) else edit.start
        end = max(edit.end, start)
        if start < reached or end > len(content):
            raise EditError(f"the edit of bytes {edit.start} to {edit.end} does not fit the file")
        parts.append(content[reached:start])
        parts.append(_encoded(edit.text, content, crlf=crlf))
        reached = end
    parts.append(content[reached:])
    return b"".join(parts)


def _encoded(text: str, content: bytes, *, crlf: bool) -> bytes:
    text = text.replace("\r\n", "\n")
    if crlf:
        text = text.replace("\n", "\r\n")
    if not text.isascii() and not _is_utf8(content):
        raise EditError("the file is not UTF-8, and what would be written is not ASCII")
    return text.encode()


def _is_utf8(content: bytes) -> bool:
    try:
        content.decode()
    except UnicodeDecodeError:
        return False
    return True
