"""A page's content as a section among others in one file: names that meet nowhere, links that lead somewhere.

The content comes from our own templates with every text escaped, so quotation marks distinguish an attribute from text:
text holds ``&#34;`` instead.
"""

from __future__ import annotations

import re
from html import escape, unescape
from urllib.parse import quote, unquote

from roslens.dashboard.address import PageRef, section_id

_BETWEEN = re.compile(r"\n\s+(?=<)")
_PLAIN_LINE = re.compile(r'<div class="row" id="L\d+">')
_LINE_NUMBER = re.compile(r'<a class="n" href="#L\d+" aria-label="line \d+">(\d+)</a>')
_FINDING_ID = re.compile(r' id="f-[^"]*"')
_NAME = re.compile(r' (id|for|list|aria-controls|aria-labelledby)="([^"]*)"')
_CUT_TABLE = re.compile(r'<table data-total="(\d+)">.*?</table>', re.DOTALL)
_SORT_LINK = re.compile(r'<a href="[^"]*" data-sort="[^"]*">([^<]*)</a>')
_HREF = re.compile(r' href="#([^"]*)"')
_IDS = re.compile(r' id="([^"]*)"')


def compact(text: str) -> str:
    """Return HTML without the indentation of its elements; text within ``pre`` keeps its own."""
    return _BETWEEN.sub("\n", text)


def fold_into_file(ref: PageRef, content: str) -> str:
    """Return the section. Scripts look for the names of the graph, which is there once, so it keeps them."""
    own = escape(section_id(ref), quote=True)
    content = compact(content)
    if ref.page != "graph":
        content = _PLAIN_LINE.sub('<div class="row">', content)
        content = _LINE_NUMBER.sub(r'<span class="n">\1</span>', content)
        content = _FINDING_ID.sub("", content)
        content = _NAME.sub(lambda match: f' {match[1]}="{own}:{match[2]}"', content)
    content = _CUT_TABLE.sub(_without_dead_sorting, content)
    return f'<section id="{own}" class="page-{ref.page}">\n{content}</section>\n'


def _without_dead_sorting(table: re.Match[str]) -> str:
    """A table that holds some of its rows cannot be sorted where no server has the others."""
    rows = table[0].partition("<tbody>")[2].count("<tr")
    return _SORT_LINK.sub(r"\1", table[0]) if int(table[1]) > rows else table[0]


def with_live_links(sections: str) -> str:
    """Return the sections with links to what is not among them taken away, and places that are not there cut off."""
    known = {unescape(name) for name in _IDS.findall(sections)}

    def live(match: re.Match[str]) -> str:
        path, mark, query = unescape(match[1]).partition("?")
        name = unquote(path)
        if name in known or name.startswith("g-"):
            return match[0]
        section = name.rpartition(":")[0]
        if section not in known:
            return ""
        return f' href="#{escape(quote(section, safe="/@:+") + mark + query)}"'

    return _HREF.sub(live, sections)
