"""Where names and paths may break: between their parts, so that none is cut inside a word where there is room."""

from __future__ import annotations

import re

from markupsafe import Markup, escape

_LONG = re.compile(r"[A-Za-z0-9_.]{25,}")
"""A part of a path for which a narrow screen has no room on one line."""


def breakable(text: str) -> Markup:
    """Return a text, escaped, with places where it may break.

    Paths break behind slashes, and inside a part only where that is long; other names behind what joins their words.
    """
    return Markup(with_breaks(str(escape(text))))  # noqa: S704 - the text was escaped


def with_breaks(text: str) -> str:
    """Return escaped text with places where it may break."""
    if "/" in text:
        text = _LONG.sub(lambda match: match[0].replace("_", "_<wbr>"), text)
        ends: tuple[str, ...] = ("/", "::")
    else:
        ends = ("::", "_", ".", "(", "-&gt;")
    for end in ends:
        text = text.replace(end, f"{end}<wbr>")
    # What begins with a slash is the name of a node or topic; the slash alone on a line is useless.
    return f" {text}".replace(" /<wbr>", " /")[1:]
