"""YAML text as a tree of nodes that know their place. Built from events: no object is ever constructed."""

from __future__ import annotations

import re
from functools import lru_cache
from typing import TYPE_CHECKING, Any, NoReturn

import msgspec

from roslens.model.errors import DocumentError
from roslens.model.source import Location

if TYPE_CHECKING:
    from collections.abc import Iterator

MAX_DEPTH = 20
"""Lists and tables inside each other; no document of ours needs five."""

MAX_BYTES = 1_000_000
MAX_NODES = 200_000
"""Values with those that aliases stand for: aliases of aliases grow without bound."""
_BREAK = re.compile("\r\n|[\r\n\x85\u2028\u2029]")
_NEEDS_QUOTES = re.compile(r"(?::|^\s*-)\s+[*>{\[&!%@`|]")
"""A value whose first sign means something to YAML: ``**/scan``, ``>= 5 Hz``."""

_UNREADABLE = re.compile("[^\t\n\r\x20-\x7e\x85\xa0-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")


class Place(msgspec.Struct, frozen=True, array_like=True):
    """Where a node begins: 1-based line, 0-based column in characters."""

    line: int
    column: int


_TEXT_TAG = "tag:yaml.org,2002:str"


class Scalar(msgspec.Struct, frozen=True):
    """A single value as written; ``plain`` when it stands without quotes."""

    place: Place
    text: str
    plain: bool

    @property
    def empty(self) -> bool:
        """Whether there is no value at all (``key:``, ``key: ~`` or ``key: null``)."""
        return self.plain and self.text in {"", "~", "null", "Null", "NULL"}

    @property
    def each(self) -> tuple[Node, ...]:
        """It alone, as the items of a list of one."""
        return (self,)


class Items(msgspec.Struct, frozen=True):
    """A list."""

    place: Place
    nodes: tuple[Node, ...]

    @property
    def each(self) -> tuple[Node, ...]:
        """Its items."""
        return self.nodes


class Table(msgspec.Struct, frozen=True):
    """A mapping from texts to nodes, with the place of each key."""

    place: Place
    nodes: dict[str, Node]
    keys: dict[str, Place]

    @property
    def each(self) -> tuple[Node, ...]:
        """It alone, as the items of a list of one."""
        return (self,)

    @property
    def texts(self) -> dict[str, str]:
        """The single values in it as written, by their keys."""
        return {key: node.text for key, node in self.nodes.items() if isinstance(node, Scalar)}


Node = Scalar | Items | Table


class Tree(msgspec.Struct, frozen=True):
    """A document: its name as shown in messages, its text, its outermost node (None when empty)."""

    shown: str
    text: str
    root: Node | None

    def location(self, place: Place) -> Location:
        """Return a place as a location with its column in bytes."""
        return _location(self.shown, self.text, place)


def read_tree(content: bytes, shown: str, *, last_counts: bool = False) -> Tree:
    """Read a YAML document.

    Args:
        content: the bytes of the file.
        shown: the name of the file in messages.
        last_counts: whether a key may be named twice, and the last one counts, as PyYAML takes it.

    Raises:
        DocumentError: the bytes are not UTF-8, the text is no YAML, holds several documents, nests too deeply or
            names a key twice.
    """
    text = _decode(content, shown)
    return Tree(shown, text, _Builder(shown, text, last_counts=last_counts).build())


def read_parameter_trees(content: bytes, shown: str) -> tuple[Tree, ...]:
    """Read a file of parameters of ROS 2 as rcl does: its documents one after the other, with the tags that it knows.

    A value with the tag ``!!str`` is a text; all other tags are as if they were not there (rcl_yaml_param_parser,
    parse.c, ``get_value`` and ``parse_file_events``).

    Args:
        content: the bytes of the file.
        shown: the name of the file in messages.

    Raises:
        DocumentError: the bytes are not UTF-8, the text is no YAML, or nests too deeply.
    """
    text = _decode(content, shown)
    roots = _Builder(shown, text, last_counts=True, of_rcl=True).all()
    return tuple(Tree(shown, text, root) for root in roots)


def _decode(content: bytes, shown: str) -> str:
    if len(content) > MAX_BYTES:
        raise DocumentError(f"a file of {len(content):,} bytes", where=shown, expected=f"at most {MAX_BYTES:,} bytes")
    try:
        return content.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        before = error.object[: error.start]
        line_start = before.rfind(b"\n") + 1
        raise DocumentError(
            f"byte 0x{error.object[error.start]:02x} is not UTF-8",
            where=Location(shown, before.count(b"\n") + 1, error.start - line_start + 1),
            expected="a text file in UTF-8",
            advice="Save the file in that encoding",
        ) from None


@lru_cache(maxsize=8)
def _lines(text: str) -> tuple[str, ...]:
    """Return the lines of a document, which is asked for the place of each of its constraints."""
    return tuple(_BREAK.split(text))


def _location(shown: str, text: str, place: Place) -> Location:
    lines = _lines(text)
    before = lines[place.line - 1][: place.column] if place.line <= len(lines) else ""
    return Location(shown, place.line, len(before.encode()) + 1)


class _Builder:
    """Builds nodes from the events of one text."""

    def __init__(self, shown: str, text: str, *, last_counts: bool, of_rcl: bool = False) -> None:
        self._shown = shown
        self._text = text
        self._last_counts = last_counts
        self._of_rcl = of_rcl
        self._anchors: dict[str, tuple[Node, int]] = {}
        self._nodes = 0
        self._events: Iterator[Any] = iter(())

    def build(self) -> Node | None:
        """Return the root of the only document; None where there is no value."""
        return next(iter(self.all()), None)

    def all(self) -> list[Node]:
        """Return the roots of all documents that have a value."""
        import yaml

        if unreadable := _UNREADABLE.search(self._text):
            lines = _BREAK.split(self._text[: unreadable.start()])
            place = Place(len(lines), len(lines[-1]))
            self._fail(place, f"character {unreadable[0]!r}", "text without control characters", "Remove it")
        roots: list[Node] = []
        try:
            self._events = yaml.parse(self._text, getattr(yaml, "CSafeLoader", yaml.SafeLoader))
            for event in self._events:
                if isinstance(event, yaml.DocumentStartEvent):
                    if roots and not self._of_rcl:
                        self._fail(_place(event), "a second document", "one document in a file", "Remove from `---` on")
                    roots.append(self._node(next(self._events), 0))
        except yaml.MarkedYAMLError as error:
            self._broken(error)
        return [root for root in roots if not (isinstance(root, Scalar) and root.empty)]

    def _node(self, event: Any, depth: int) -> Node:
        import yaml

        node: Node
        if depth > MAX_DEPTH:
            self._fail(_place(event), f"more than {MAX_DEPTH} levels", "lists and tables that are less deeply nested")
        if isinstance(event, yaml.AliasEvent):
            if event.anchor not in self._anchors:
                self._fail(_place(event), f"'*{event.anchor}' refers to nothing", f"an anchor '&{event.anchor}' before")
            node, nodes = self._anchors[event.anchor]
            self._nodes += nodes
            if self._nodes > MAX_NODES:
                self._fail(
                    _place(event), f"more than {MAX_NODES:,} values", "fewer aliases of aliases", "Write them out"
                )
            return node
        if event.tag and not self._of_rcl:
            self._fail(_place(event), f"the YAML tag {event.tag!r}", "a value without a tag", "Remove it")
        before = self._nodes
        self._nodes += 1
        if isinstance(event, yaml.ScalarEvent):
            plain = event.style in {None, ""} and not (self._of_rcl and event.tag == _TEXT_TAG)
            node = Scalar(_place(event), event.value, plain)
        elif isinstance(event, yaml.SequenceStartEvent):
            node = Items(_place(event), tuple(self._list(depth)))
        else:
            node = self._table(_place(event), depth)
        if event.anchor:
            self._anchors[event.anchor] = node, self._nodes - before
        return node

    def _list(self, depth: int) -> Iterator[Node]:
        import yaml

        while not isinstance(event := next(self._events), yaml.SequenceEndEvent):
            yield self._node(event, depth + 1)

    def _table(self, place: Place, depth: int) -> Table:
        import yaml

        nodes: dict[str, Node] = {}
        keys: dict[str, Place] = {}
        while not isinstance(event := next(self._events), yaml.MappingEndEvent):
            key = self._node(event, depth + 1)
            if not isinstance(key, Scalar):
                self._fail(key.place, "a list or table as a key", "a word before the colon")
            if key.text in keys and not self._last_counts:
                first = keys[key.text].line
                self._fail(key.place, f"key {key.text!r} a second time", f"it once (first in line {first})")
            keys[key.text] = key.place
            nodes[key.text] = self._node(next(self._events), depth + 1)
        return Table(place, nodes, keys)

    def _fail(self, place: Place, what: str, expected: str, advice: str = "") -> NoReturn:
        raise DocumentError(what, where=_location(self._shown, self._text, place), expected=expected, advice=advice)

    def _broken(self, error: Any) -> NoReturn:
        mark = error.problem_mark or error.context_mark
        place = Place(mark.line + 1, mark.column)
        lines = _BREAK.split(self._text)
        line = lines[mark.line] if mark.line < len(lines) else ""
        if "\t" in line[: len(line) - len(line.lstrip())]:
            column = line.index("\t")
            self._fail(Place(place.line, column), "a tab in the indentation", "spaces", "Replace the tab by spaces")
        quoted = f" at {line.strip()[:60]!r}" if line.strip() else ""
        context = f" {error.context}" if error.context else ""
        self._fail(
            place,
            f"cannot be read as YAML{quoted}: {error.problem}{context}",
            "`key: value` lines and `- ` lists",
            "Put the value in quotes" if _NEEDS_QUOTES.search(line) else "",
        )


def _place(event: Any) -> Place:
    return Place(event.start_mark.line + 1, event.start_mark.column)
