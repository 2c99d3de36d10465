"""Macros that a C++ grammar cannot read, blanked in place so that positions hold.

A grammar sees source before macros are expanded: an export macro turns a class into a function, a registration macro
without a semicolon swallows what follows. Which macros do that is data (``presets/ros_macros.toml``, where each kind
is explained) and can be extended per project. What is done to source keeps its length and its line breaks.

Two steps keep it cheap. :meth:`MacroPreset.blank` runs on every file: all its macros have an underscore, so looking at
underscores finds them. :meth:`MacroPreset.repair` knows what is rarer or costly to find, also C++ that the grammar
does not know, and is meant for files that still have errors.
"""

from __future__ import annotations

import re
import sys
from collections.abc import Callable, Iterable, Sequence
from hashlib import blake2b
from importlib.resources import files
from typing import Any, NamedTuple

from roslens.source.settings import MacroSettings
from roslens.source.syntax.macro.macro_blocks import name_blocks
from roslens.source.syntax.macro.macro_edits import EDITS, blank_linkage, fill
from roslens.source.syntax.macro.macro_statements import blank_statements
from roslens.source.syntax.macro.own_macros import OwnMacros

if sys.version_info >= (3, 11):
    import tomllib
else:
    import tomli as tomllib

_WORD = frozenset(b"abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_")
_QUICK_KINDS = ("before_declaration", "anywhere", "statement", "loop")
_REPAIR_KINDS = ("loop", "keyword", "opaque", "block")
_LONGEST_WORD = 200
_LONGEST_LINE = 400
_REMEMBERED = 10_000
_MOST_UNCLOSED = 20


class _Rewrite(NamedTuple):
    """What a pattern finds becomes something else.

    Attributes:
        words: of which a file has to hold one; none for any file.
        needs: a pattern that is found much sooner and has to be there.
        pattern: its group is what is replaced.
        with_: what takes its place.
    """

    words: Sequence[bytes]
    needs: re.Pattern[bytes] | None
    pattern: re.Pattern[bytes]
    with_: bytes


class MacroPreset:
    """A compiled set of macros.

    Attributes:
        version: changes whenever the preset or the settings do; belongs into cache keys.
    """

    def __init__(self, preset: bytes, settings: MacroSettings) -> None:
        """Compile.

        Args:
            preset: the text of a preset file.
            settings: what the project adds.

        Raises:
            ValueError: a name in the settings is not a regular expression, or none that is matched in one pass.
        """
        table = tomllib.loads(preset.decode())
        key = blake2b(preset, digest_size=8)
        key.update(repr((settings.blank, settings.statement)).encode())
        self.version = f"{table['version']}-{key.hexdigest()}"
        quick = {kind: table[kind] for kind in _QUICK_KINDS}
        self._kinds = {kind: re.compile(_names(row)) for kind, row in quick.items()}
        self._underscored = re.compile(_triggers(quick.values()))
        self._kind_of: dict[bytes, str] = {b"__cplusplus": "linkage"}
        self._own = OwnMacros({"anywhere": settings.blank, "statement": settings.statement})
        repair = {kind: table["repair"][kind] for kind in _REPAIR_KINDS}
        self._repaired = [(kind, _word(word)) for kind, words in repair.items() for word in words]
        self._rewrites = list(map(_rewrite, table["rewrite"]))
        self._last_rewrites = list(map(_rewrite, table["last_rewrite"]))

    def blank(self, content: bytes) -> bytes:
        """Return ``content`` with the macros of the preset and the project blanked."""
        found = [(*_whole_word(content, match.start()), "") for match in self._underscored.finditer(content)]
        found = [(start, end, self._kind(content[start:end])) for start, end, _ in found]
        found += self._own.find(content)
        return _edited(content, found) if found else content

    def repair(self, content: bytes) -> bytes:
        """Return ``content``, blanked before, with what only files with errors need rewritten."""
        found = [(*match.span(), kind) for kind, word in self._repaired for match in word.finditer(content)]
        if found:
            content = _edited(content, found)
        return _rewritten(blank_statements(content), self._rewrites)

    def repair_last(self, content: bytes) -> bytes:
        """Return ``content``, repaired before, with what only files need rewritten that have errors all the same."""
        return _rewritten(name_blocks(content), self._last_rewrites)

    def _kind(self, word: bytes) -> str:
        kind = self._kind_of.get(word)
        if kind is None:
            kind = next((kind for kind, words in self._kinds.items() if words.fullmatch(word)), "")
            if len(self._kind_of) < _REMEMBERED:
                self._kind_of[word] = kind
        return kind


def _rewrite(row: dict[str, Any]) -> _Rewrite:
    needs = row.get("needs")
    return _Rewrite(
        list(map(str.encode, row.get("words", ()))),
        None if needs is None else re.compile(needs.encode()),
        re.compile(row["pattern"].encode()),
        row["with"].encode(),
    )


def _rewritten(content: bytes, rewrites: Iterable[_Rewrite]) -> bytes:
    for words, needs, pattern, with_ in rewrites:
        if (words and not any(word in content for word in words)) or (needs and not needs.search(content)):
            continue
        spans = [match.span(1) for match in pattern.finditer(content)]
        if spans:
            text = bytearray(content)
            for start, end in spans:
                fill(text, start, end, with_)
            content = bytes(text)
    return content


def load_macros(extra: MacroSettings | None = None) -> MacroPreset:
    """Load the preset that ships with roslens and add what the project's settings name.

    Raises:
        ValueError: a name in the settings is not a regular expression, or none that is matched in one pass.
    """
    preset = files("roslens.source.syntax").joinpath("presets/ros_macros.toml").read_bytes()
    return MacroPreset(preset, extra or MacroSettings())


def _names(row: dict[str, list[str]]) -> bytes:
    """Return a pattern of whole words for the words and suffixes of a kind."""
    suffixes = "|".join(map(re.escape, row.get("suffixes", ())))
    words = "|".join(map(re.escape, row.get("words", ())))
    return (f"[A-Z0-9_]*(?:{suffixes})|{words}" if suffixes else words).encode()


def _triggers(rows: Iterable[dict[str, list[str]]]) -> bytes:
    """Return a pattern for the ends of all words, from their first underscore on: it starts with one fixed byte."""
    ends: dict[str, set[str]] = {"_": {"cplusplus"}}
    for row in rows:
        for word in [*row.get("suffixes", ()), *row.get("words", ())]:
            end = word[word.index("_") + 1 :]
            ends.setdefault(end[0], set()).add(end[1:])
    branches = [
        f"{re.escape(first)}(?:{'|'.join(map(re.escape, sorted(rest)))})" for first, rest in sorted(ends.items())
    ]
    initials = re.escape("".join(sorted(ends)))
    return f"_(?=[{initials}])(?:{'|'.join(branches)})(?![A-Za-z0-9_])".encode()


def _word(name: str) -> re.Pattern[bytes]:
    """Return a pattern of one whole word; that it starts with fixed bytes makes it cheaper than all words in one."""
    word = re.escape(name)
    return re.compile(f"{word}(?<![A-Za-z0-9_]{word})(?![A-Za-z0-9_])".encode())


def _whole_word(content: bytes, position: int) -> tuple[int, int]:
    start = end = position
    first, last = max(0, position - _LONGEST_WORD), min(len(content), position + _LONGEST_WORD)
    while start > first and content[start - 1] in _WORD:
        start -= 1
    while end < last and content[end] in _WORD:
        end += 1
    return start, end


def _edited(content: bytes, found: list[tuple[int, int, str]]) -> bytes:
    """Apply the edits in order; what stands in the arguments of an edited macro or in a directive is left."""
    text = bytearray(content)
    unclosed = done = 0
    for start, end, kind in sorted(found):
        if not kind or start < done or unclosed > _MOST_UNCLOSED:
            continue
        if kind == "linkage":
            blank_linkage(content, text, start)
        elif not _in_directive(content, start):
            edit: Callable[..., int] = EDITS[kind]
            done = edit(content, text, start, end)
            unclosed += done < 0
    return bytes(text)


def _in_directive(content: bytes, position: int) -> bool:
    line_start = content.rfind(b"\n", max(0, position - _LONGEST_LINE), position) + 1
    return content[line_start:position].lstrip().startswith(b"#")
