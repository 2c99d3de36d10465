"""Names of entities in texts on references, as links to what is known of them as they run."""

from __future__ import annotations

import re
from urllib.parse import quote

from markupsafe import Markup, escape

_NAME = r"/[\w/.-]*\w(?![\w/*?\[{|])"
"""The whole name of one node, topic, service or action; a pattern of names is none."""
_NAMED = re.compile(
    rf"\b(?P<kind>node|topic|service|action)(?P<between>[ :])(?P<name>{_NAME})"
    r"|\bhost(?::|[ ](?=[\w.-]+ is\b))(?P<host>[\w.-]*\w(?![\w*?\[{|]))"
    rf"|(?:\bfield \S+ of |\bdata over | > )(?P<topic>{_NAME})"
)


def linked(text: str, live: str) -> Markup:
    """Return the text, everything in it escaped, with links to the page of what runs; without one only the text."""
    if not live:
        return escape(text)
    parts: list[Markup] = []
    begin = 0
    for found in _NAMED.finditer(text):
        group = found.lastgroup or ""
        kind = found["kind"] or group
        start, end = found.span(group)
        address = f"{live}?select={quote(f'{kind}:{found[group]}')}"
        parts += [escape(text[begin:start]), Markup('<a class="entity" href="{}">{}</a>').format(address, found[group])]
        begin = end
    return Markup("").join([*parts, escape(text[begin:])])
