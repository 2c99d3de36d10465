r"""Control characters in what is written: shown instead of handed to the terminal of whoever reads it.

Names and texts come from the source that is analysed, and a terminal obeys what is in them: it moves the cursor,
renames its window or hides what stood there. Each such character becomes ``\u001b`` and so on, which JSON reads as the
character itself. Tabs and ends of lines stay.
"""

from __future__ import annotations

import io
import re

_TEXT = re.compile("[\x00-\x08\x0b\x0c\x0e-\x1f\x7f-\x9f]|\r(?!\n|\\Z)")
_OF_TERMINAL = r"\[[0-9;]*m|\[[HJK]|\[\?(?:25|1049)[hl]"
"""What roslens itself sends to a terminal after an escape: colours, and what writes a line or the screen over."""

_TEXT_OF_TERMINAL = re.compile(
    rf"[\x00-\x08\x0b\x0c\x0e-\x1a\x1c-\x1f\x7f-\x9f]|\x1b(?!{_OF_TERMINAL})|\r(?!\n|\Z|\x1b\[K)"
)
_BYTES = re.compile(rb"[\x00-\x08\x0b\x0c\x0e-\x1f\x7f]|\xc2[\x80-\x9f]|\r(?!\n|\Z)")


def shown_controls(text: str, *, colours: bool = False) -> str:
    """Return a text with its control characters written out; with ``colours``, but for those that roslens itself sends.

    What comes from source is cleaned before it is coloured: of what slips through, a terminal obeys no more than these.
    """
    pattern = _TEXT_OF_TERMINAL if colours else _TEXT
    return pattern.sub(_written_out, text) if pattern.search(text) else text


def shown_control_bytes(content: bytes) -> bytes:
    """Return UTF-8 with its control characters written out."""
    return _BYTES.sub(_written_out_bytes, content) if _BYTES.search(content) else content


class ShownControls(io.TextIOWrapper):
    """A stream of text that writes control characters out."""

    def write(self, text: str, /) -> int:
        """Write text."""
        return super().write(shown_controls(text))


def _written_out(found: re.Match[str]) -> str:
    return f"\\u{ord(found[0]):04x}"


def _written_out_bytes(found: re.Match[bytes]) -> bytes:
    return b"\\u00%02x" % found[0][-1]
