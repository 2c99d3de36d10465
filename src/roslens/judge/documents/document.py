"""Documents in YAML: typed access to their keys, with errors that state where and what was expected.

Models for source and references for live systems are read through this one page. Texts are taken as
written: ``name: no`` and ``version: 1.10`` are what they look like, not what YAML makes of them.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Mapping
from enum import Enum
from pathlib import Path
from typing import NoReturn, TypeVar

from roslens.intake.bounded_file import read_bounded
from roslens.judge.documents.plain_value import Value, plain_value
from roslens.judge.documents.yaml_tree import Items, Node, Place, Scalar, Table, Tree, read_tree
from roslens.model.errors import DocumentError
from roslens.model.source import Location
from roslens.plugins.nearest import did_you_mean

_NUMBER = re.compile(r"[-+]?(?:\d+(?:\.\d*)?|\.\d+)(?:[eE][-+]?\d+)?\Z")

_LISTED = 30
"""Keys that are all reported, beside the one that was meant."""

Choice = TypeVar("Choice", bound=Enum)


class Section:
    """A mapping of a document.

    ``what`` is what messages call it (``model``, ``constraint``); ``keys`` maps the keys it may have to
    what they mean.
    """

    def __init__(self, tree: Tree, table: Table, what: str, keys: Mapping[str, str]) -> None:
        """Refuse keys that are not among ``keys``.

        Raises:
            DocumentError: an unknown key, with its place, the valid ones and the nearest of them.
        """
        self._tree = tree
        self._table = table
        self._what = what
        for key, place in table.keys.items():
            if key not in keys:
                meant = did_you_mean(key, keys)
                # A long list hides the word that is meant.
                many = meant and len(keys) > _LISTED
                expected = f"one of its {len(keys)} keys" if many else f"one of {', '.join(keys)}"
                self._fail(place, f"unknown key {key!r} of a {what}", expected, meant)

    def __contains__(self, key: str) -> bool:
        """Whether the key is there."""
        return key in self._table.nodes

    def fault(self, key: str, what: str, *, expected: str = "", advice: str = "") -> DocumentError:
        """Return an error about the value of ``key``, or about the whole section when it is not there."""
        node = self._table.nodes.get(key)
        place = node.place if node is not None else self._table.place
        return DocumentError(what, where=self._tree.location(place), expected=expected, advice=advice)

    def location(self, key: str = "") -> Location:
        """Return where the section begins, or where ``key`` stands in it."""
        return self._tree.location(self._table.keys.get(key, self._table.place))

    def line(self) -> int:
        """Return the line in which the section begins."""
        return self._table.place.line

    def text(self, key: str, default: str | None = None) -> str:
        """Return a text as written.

        Raises:
            DocumentError: there is none and no ``default``, or it is a list or a table.
        """
        node = self._given(key, required=default is None)
        if node is None:
            return default or ""
        if not isinstance(node, Scalar):
            self._mistyped(key, node, "a text", "A text that begins with a brace or bracket needs quotes")
        return node.text.strip()

    def texts(self, key: str) -> tuple[str, ...]:
        """Return a list of texts; a single text is a list of one.

        Raises:
            DocumentError: it is neither.
        """
        node = self._given(key, required=False)
        if node is None:
            return ()
        nodes = node.nodes if isinstance(node, Items) else (node,)
        found = []
        for item in nodes:
            if not isinstance(item, Scalar) or item.empty:
                self._mistyped(key, item, "a list of texts")
            found.append(item.text.strip())
        return tuple(found)

    def number(self, key: str) -> float | None:
        """Return a number, None where the key is not there.

        Raises:
            DocumentError: it is no decimal number.
        """
        node = self._given(key, required=False)
        if node is None:
            return None
        if not isinstance(node, Scalar) or not node.plain or not _NUMBER.match(node.text):
            quoted = isinstance(node, Scalar) and not node.plain and bool(_NUMBER.match(node.text))
            self._mistyped(key, node, "a number", "Remove the quotes" if quoted else "")
        return float(node.text)

    def choice(
        self, key: str, kinds: type[Choice], default: Choice | None = None, among: Collection[Choice] = ()
    ) -> Choice:
        """Return the member of an enumeration, ``default`` where the key is not there.

        Raises:
            DocumentError: it is none of the values, none of ``among``, or not there and without ``default``.
        """
        if key not in self and default is not None:
            return default
        word = self.text(key)
        valid = [str(kind.value) for kind in (among or kinds)]
        if word not in valid:
            raise self.fault(
                key, f"{key} is {word!r}", expected=f"one of {', '.join(valid)}", advice=did_you_mean(word, valid)
            )
        return kinds(word)

    def sections(self, key: str, what: str, keys: Mapping[str, str]) -> tuple[Section, ...]:
        """Return the mappings of a list.

        Raises:
            DocumentError: it is no list of mappings, or one of them has an unknown key.
        """
        node = self._given(key, required=False)
        if node is None:
            return ()
        if not isinstance(node, Items):
            self._mistyped(key, node, f"a list, each {what} after a `- `")
        found = []
        for item in node.nodes:
            if not isinstance(item, Table):
                self._mistyped(key, item, f"a {what} of `key: value` lines")
            found.append(Section(self._tree, item, what, keys))
        return tuple(found)

    def section(self, key: str, what: str, keys: Mapping[str, str]) -> Section | None:
        """Return the mapping under ``key``, None where the key is not there.

        Raises:
            DocumentError: it is no mapping, or has an unknown key.
        """
        node = self._given(key, required=False)
        if node is None:
            return None
        if not isinstance(node, Table):
            self._mistyped(key, node, f"a {what} of `key: value` lines below it")
        return Section(self._tree, node, what, keys)

    def given(self) -> tuple[str, ...]:
        """Return the keys that are there, in their order."""
        return tuple(self._table.nodes)

    def is_table(self, key: str) -> bool:
        """Whether there is a mapping under ``key``."""
        return isinstance(self._table.nodes.get(key), Table)

    def value(self, key: str) -> Value:
        """Return whatever is under ``key`` as a value of JSON; None where the key is not there."""
        node = self._table.nodes.get(key)
        return None if node is None else plain_value(node)

    def _given(self, key: str, *, required: bool) -> Node | None:
        node = self._table.nodes.get(key)
        if node is not None and not (isinstance(node, Scalar) and node.empty):
            return node
        if node is not None:
            self._fail(
                self._table.keys[key], f"{key} has no value", "a value behind the colon", "Give it or remove the key"
            )
        if required:
            self._fail(self._table.place, f"a {self._what} without {key!r}", f"the line `{key}: …`")
        return None

    def _mistyped(self, key: str, node: Node, expected: str, advice: str = "") -> NoReturn:
        self._fail(node.place, f"{key} is {described(node)}", expected, advice)

    def _fail(self, place: Place, what: str, expected: str, advice: str = "") -> NoReturn:
        raise DocumentError(what, where=self._tree.location(place), expected=expected, advice=advice)


def described(node: Node) -> str:
    """Return what a node is, quoted, for a message."""
    if isinstance(node, Items):
        return "a list"
    if isinstance(node, Table):
        return "a table"
    return "nothing" if node.empty else repr(node.text[:60])


def read_document(path: Path, what: str, keys: Mapping[str, str], *, shown: str = "") -> Section:
    """Read the outermost mapping of a document.

    Args:
        path: of the file.
        what: what the document is, for messages.
        keys: the keys it may have and what they mean.
        shown: the name of the file in messages; by default the path.

    Raises:
        DocumentError: the file cannot be read, is no YAML, is empty, or has keys that are unknown.
    """
    name = shown or str(path)
    try:
        content = read_bounded(path)
    except OSError as error:
        reason = error.strerror or str(error)
        raise DocumentError(
            f"cannot read it: {reason}", where=name, expected=f"a {what} in YAML", advice="Check the path"
        ) from None
    return parse_document(content, what, keys, shown=name)


def parse_document(content: bytes, what: str, keys: Mapping[str, str], *, shown: str) -> Section:
    """Read the outermost mapping of a document that is at hand.

    Args:
        content: the bytes of the document.
        what: what the document is, for messages.
        keys: the keys it may have and what they mean.
        shown: what messages call it.

    Raises:
        DocumentError: it is no YAML, is empty, or has keys that are unknown.
    """
    tree = read_tree(content, shown)
    if tree.root is None:
        raise DocumentError("the file is empty", where=shown, expected=f"a {what} in YAML")
    if not isinstance(tree.root, Table):
        raise DocumentError(
            f"the file holds {described(tree.root)}",
            where=tree.location(tree.root.place),
            expected=f"a {what}: `key: value` lines with {', '.join(keys)}",
        )
    return Section(tree, tree.root, what, keys)
