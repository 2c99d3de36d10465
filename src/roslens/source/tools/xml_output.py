"""XML that tools print, read with nothing fetched and no entity expanded."""

from __future__ import annotations

from lxml import etree

from roslens.source.tools.tool import unreadable


def xml_root(content: bytes, tag: str) -> etree._Element:
    """Return the root of a document.

    Raises:
        ToolError: it is no XML, or its root is called otherwise.
    """
    parser = etree.XMLParser(resolve_entities=False, no_network=True, load_dtd=False, huge_tree=True)
    try:
        root = etree.fromstring(content, parser)
    except (etree.XMLSyntaxError, ValueError):
        raise unreadable(content, f"XML with the root <{tag}>") from None
    if root.tag != tag:
        raise unreadable(content, f"XML with the root <{tag}>")
    return root


def number(text: str | None) -> int:
    """Return a line or column; 0 where there is none."""
    return int(text) if text and text.isascii() and text.isdigit() else 0
