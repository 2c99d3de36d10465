"""Edits of package.xml: an element added where its kind stands, renamed, or taken away."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from roslens.model.edit import Edit, edit_at
from roslens.source.rules.spans import indent_of, line_around, whole_lines
from roslens.source.workspace.elements import Element, read_elements

_ORDER = (
    *("name", "version", "description", "maintainer", "license", "url", "author"),
    *("buildtool_depend", "buildtool_export_depend", "build_depend", "build_export_depend", "depend"),
    *("run_depend", "exec_depend", "doc_depend", "test_depend", "group_depend", "conflict", "replace"),
    *("member_of_group", "export"),
)
"""Of elements, as REP-149 and most manifests have them."""


class ManifestEdits:
    """A package.xml that was read as a whole; of another one no edit is made."""

    def __init__(self, content: bytes, path: str) -> None:
        """``path`` is that of the file, below the workspace."""
        self._content = content
        self._path = path
        document = read_elements(content)
        root = document.root
        whole = root is not None and root.tag == "package" and not document.faults
        self._root = root if whole else None
        self.format = int(form) if whole and root and (form := root.attributes.get("format", "1")).isdigit() else 0

    def elements(self, tag: str = "", text: str = "") -> Iterator[Element]:
        """Yield the elements below the root of a name and with a text, both empty for any."""
        for one in self._root.elements() if self._root is not None else ():
            if tag in ("", one.tag) and text in ("", one.text()):
                yield one

    def element_at(self, line: int) -> Element | None:
        """Return the only element that begins in a line, 1-based."""
        found = [one for one in self.elements() if self._content.count(b"\n", 0, one.start) + 1 == line]
        return found[0] if len(found) == 1 else None

    def added(self, tag: str, text: str) -> tuple[Edit, ...]:
        """Return what adds an element behind those of its kind; nothing where it is not known where."""
        before = [one for one in self.elements() if one.tag in _ORDER[: _ORDER.index(tag) + 1]]
        same = [one for one in before if one.tag == tag]
        if not before:
            return ()
        behind = max(same or before, key=lambda one: (_ORDER.index(one.tag), one.end))
        if not same:
            behind = max((one for one in before if one.tag == behind.tag), key=lambda one: one.end)
        at = self._end_of_line(behind)
        indent = indent_of(self._content, behind.start)
        return (edit_at(self._content, at, at, f"\n{indent}<{tag}>{text}</{tag}>", self._path),)

    def removed(self, element: Element) -> tuple[Edit, ...]:
        """Return what takes an element away, with its line where it stands alone."""
        start, end = whole_lines(self._content, element.start, element.end)
        return (edit_at(self._content, start, end, "", self._path),)

    def renamed(self, element: Element, tag: str) -> tuple[Edit, ...]:
        """Return what gives an element another name; nothing where it is written in a form of its own."""
        written = self._content[element.start : element.end]
        begin, end = f"<{element.tag}".encode(), f"</{element.tag}>".encode()
        if not (written.startswith(begin) and written.endswith(end)):
            return ()
        first, last = element.start + 1, element.end - len(end) + 2
        length = len(element.tag)
        return tuple(edit_at(self._content, at, at + length, tag, self._path) for at in (first, last))

    def _end_of_line(self, element: Element) -> int:
        """Return the end of the line of an element where nothing but a comment follows there, else of the element."""
        _, end = line_around(self._content, element.end - 1)
        rest = self._content[element.end : end].strip()
        is_comment = rest.startswith(b"<!--") and rest.endswith(b"-->") and rest.count(b"<!--") == 1
        if rest and not is_comment:
            return element.end
        return element.end + len(self._content[element.end : end].rstrip())


def joined(edits: Sequence[tuple[Edit, ...]]) -> tuple[Edit, ...]:
    """Return several edits as one lot; nothing where one of them is missing."""
    return tuple(dict.fromkeys(edit for one in edits for edit in one)) if all(edits) else ()
