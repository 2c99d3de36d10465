"""What of the files of a robot description reaches the output of xacro, and whether YAML takes it for a text."""

from __future__ import annotations

import re
from collections.abc import Collection, Mapping
from xml.parsers import expat

_SIGN = re.compile(r":(?=\s)|(?<=\s)#|\t")
"""What makes YAML of a text something else than a text: a key, a comment, a tab, which ends a plain text."""
_EXPRESSION = re.compile(r"\$+\{[^{}]*\}|\$\([^()]*\)")
_XACRO = "xacro:"
_KEEPS_COMMENTS = frozenset({"xacro:insert_block", "xacro:element", "xacro:attribute"})
"""Those of its own elements before which xacro leaves comments; with all others, and with calls of macros, it removes
the comments before them (``remove_previous_comments``)."""
_LEAVES_ELEMENTS = frozenset({"xacro:if", "xacro:unless", "xacro:element", "xacro:macro", "xacro:property"})
"""Those of which it copies comments inside; of a call of a macro it copies blocks, which are elements."""
_FILE = re.compile(rb"<xacro:include\b[^<>]{0,500}?([\w.-]+)[\"']")
_CALL = re.compile(rb"<xacro:([\w.:-]+)")


def has_sign(content: bytes) -> bool:
    """Return whether YAML takes a file as it is for something else than a text."""
    return _SIGN.search(content.decode("utf-8", "replace")) is not None


def output_has_sign(files: Mapping[str, bytes]) -> bool:
    """Return whether YAML may take what xacro makes of some files, by their paths, for something else than a text."""
    included = {name.decode("utf-8", "replace") for one in files.values() for name in _FILE.findall(one)}
    called = {name.decode("utf-8", "replace") for one in files.values() for name in _CALL.findall(one)}
    return any(_Reading(path.rpartition("/")[2] in included, called).has_sign(one) for path, one in files.items())


class _Reading:
    """One pass over a file, which tells what xacro copies (``eval_all`` of xacro 2)."""

    def __init__(self, is_included: bool, called: Collection[str]) -> None:
        self._is_included = is_included
        self._called = called
        self._found = False
        self._tags: list[str] = []
        self._silent = 0
        """Depth from which on nothing reaches the output; 0 for none."""
        self._waiting: list[str] = []
        """Comments that an element behind them may remove."""

    def has_sign(self, content: bytes) -> bool:
        """Return whether something that is copied has a sign."""
        if b"<!ENTITY" in content:
            return has_sign(content)
        parser = expat.ParserCreate()
        parser.buffer_text = True
        parser.StartElementHandler = self._start
        parser.EndElementHandler = self._end
        parser.CommentHandler = self._comment
        parser.CharacterDataHandler = self._text
        try:
            parser.Parse(content, True)
        except expat.ExpatError:
            # What is no XML ends xacro, before anything is read as YAML.
            return self._found
        self._keep()
        return self._found

    def _start(self, tag: str, attributes: Mapping[str, str]) -> None:
        is_own = tag.startswith(_XACRO)
        if is_own and tag not in _KEEPS_COMMENTS:
            self._waiting.clear()
        self._keep()
        self._tags.append(tag)
        is_unused = tag == "xacro:macro" and attributes.get("name", "").removeprefix(_XACRO) not in self._called
        if is_unused and not self._silent:
            self._silent = len(self._tags)
        if not is_own:
            self._look(*(_EXPRESSION.sub("x", one) for name, one in attributes.items() if not name.startswith(_XACRO)))

    def _end(self, _tag: str) -> None:
        self._keep()
        if self._silent == len(self._tags):
            self._silent = 0
        self._tags.pop()

    def _comment(self, text: str) -> None:
        around = self._tags[-1] if self._tags else ""
        is_dropped = self._is_included if not around else around.startswith(_XACRO) and around not in _LEAVES_ELEMENTS
        if not is_dropped and "xacro:eval-comments" not in text:
            self._waiting.append(text)

    def _text(self, text: str) -> None:
        if not text.isspace():
            self._keep()
            self._look(_EXPRESSION.sub("x", text))
        elif text.count("\n") > 1:
            self._keep()

    def _keep(self) -> None:
        self._look(*self._waiting)
        self._waiting.clear()

    def _look(self, *texts: str) -> None:
        self._found = self._found or (not self._silent and any(map(_SIGN.search, texts)))
