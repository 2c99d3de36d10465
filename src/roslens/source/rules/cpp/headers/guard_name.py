"""Rule ``cpp.guard_name``: a header guard that is not named after its file."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterator
from pathlib import PurePosixPath

from roslens.model.edit import Edit, edit_at
from roslens.model.source import Language, Role
from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.hit import GUARD_NAME, Hit
from roslens.source.rules.package_view import PackageView
from roslens.source.rules.rule import PackageRule

_GUARD = re.compile(rb"^[ \t]*#[ \t]*ifndef[ \t]+(\w+)[^\n]*\n(?:[ \t]*\n)*[ \t]*#[ \t]*define[ \t]+\1\b", re.MULTILINE)
_END = re.compile(rb"#[ \t]*endif([^\r\n]*)\s*\Z")
_WORD = re.compile(rb"[A-Za-z_]\w*")
_HEADERS = frozenset({".h", ".hh", ".hpp", ".hxx"})


def found(view: PackageView) -> Iterator[Hit]:
    """Yield each guard that is named otherwise, or whose end is not named."""
    elsewhere = _Words(view)
    for file in view.of_language(Language.CPP, Language.C, roles=(Role.OWN,)):
        path = PurePosixPath(file.path)
        if path.suffix not in _HEADERS:
            continue
        text = view.read(file.path)
        match = _GUARD.search(text)
        if match is None:
            continue
        name = match[1].decode("utf-8", "replace")
        wanted = re.sub(r"\W", "_", path.name).upper()
        line = text.count(b"\n", 0, match.start(1)) + 1
        edits: tuple[Edit, ...] = ()
        end = _END.search(text)
        if _plain(wanted) not in _plain(name):
            edits = _renamed(text, match[1], elsewhere, file.path)
            yield Hit(
                "cpp.guard_name",
                f"guard `{name}`; expected one that ends in `{wanted}_`",
                line,
                context=name,
                path=file.path,
                edits=edits,
            )
        if end is not None and match[1] not in end[1]:
            last = text.count(b"\n", 0, end.start()) + 1
            message = f"the end of guard `{name}` does not name it; expected `#endif  // {name}`"
            named = GUARD_NAME if edits else name
            yield Hit(
                "cpp.guard_name",
                message,
                last,
                context=f"end {name}",
                path=file.path,
                edits=_ended(text, end, named, file.path),
            )


class _Words:
    """In how many files of a package a word stands; they are read when the first is asked for."""

    def __init__(self, view: PackageView) -> None:
        self._view = view
        self._files: Counter[bytes] | None = None

    def files_with(self, word: bytes) -> int:
        if self._files is None:
            self._files = Counter()
            for file in self._view.of_language(Language.CPP, Language.C):
                self._files.update(set(_WORD.findall(self._view.read(file.path))))
        return self._files[word]


def _renamed(text: bytes, name: bytes, words: _Words, path: str) -> tuple[Edit, ...]:
    """Return what gives a guard the name of its file, where nothing else in the package knows its old one."""
    places = [one for one in _WORD.finditer(text) if one[0] == name]
    last = text.rfind(b"#endif")
    if words.files_with(name) != 1 or sum(one.start() < last for one in places) != 2 or len(places) > 3:
        return ()
    return tuple(edit_at(text, one.start(), one.end(), GUARD_NAME, path) for one in places)


def _ended(text: bytes, end: re.Match[bytes], name: str, path: str) -> tuple[Edit, ...]:
    """Return what names a guard behind its end; another comment there is left where it says more than a name."""
    said = end[1].strip().lstrip(b"/*! ").rstrip(b"*/ ")
    if b" " in said or end[1].strip()[:2] not in (b"", b"//", b"/*"):
        return ()
    return (edit_at(text, end.start(1), end.end(1), f"  // {name}", path),)


def _plain(name: str) -> str:
    return re.sub(r"[^A-Z0-9]", "", name.upper())


RULE = PackageRule(
    id="cpp.guard_name",
    title="Name of the header guard",
    finds="A header guard whose name does not end with the name of the file, or whose `#endif` does not name "
    "it. `#pragma once` is let be.",
    why="Two headers with one guard: the second one is empty, and nothing says so.",
    consequence=Consequence.STYLE,
    certainty=Certainty.PROVEN,
    profiles=(
        "google",
        "ros-style",
        "paper2016",
    ),
    clauses=(
        "cpplint build/header_guard",
        "paper2016 header_guard_format",
        "paper2016 header_guard_close",
    ),
    fix="Renames the guard, by the profile (see `cpp.guard`), where no other file of the "
    "package knows the old name; names the end.",
    bad="#ifndef OTHER_H_\n#define OTHER_H_\n#endif\n",
    good="#ifndef ROBOT_DRIVER_H_\n#define ROBOT_DRIVER_H_\n#endif  // ROBOT_DRIVER_H_\n",
    found=found,
)
