"""3: documentation, licence, copyright and the quality declaration."""

from __future__ import annotations

import re
from collections.abc import Iterator

from roslens.intake.is_there import is_folder
from roslens.model.entity import EntityKind
from roslens.model.requirement import Item
from roslens.model.source import Language, Location
from roslens.source.evidence.answer import met, not_known, not_met
from roslens.source.evidence.package_folder import PackageFolder

_COPYRIGHT = re.compile(r"copyright|SPDX-License-Identifier|\(c\)\s+\d{4}", re.IGNORECASE)
_HEAD = 4096
_MOST = 0.9
_ABOVE = 12
_LEVEL = re.compile(r"quality\s+level\s*:?\s*\**\s*(?:category\s*)?([1-5])", re.IGNORECASE)
_CODE = (Language.C, Language.CPP, Language.PYTHON)


def claimed_level(folder: PackageFolder) -> int:
    """Return the level that the quality declaration claims, 0 for none."""
    found = _LEVEL.search(folder.text(folder.declaration))
    return int(found[1]) if found else 0


def documentation(folder: PackageFolder) -> Iterator[Item]:
    """Yield what is known of documentation."""
    yield _features(folder)
    yield _public_items(folder)
    yield _licence(folder)
    yield _copyright(folder)
    place = folder.location(folder.declaration) if folder.declaration else None
    level = claimed_level(folder)
    says = f"it claims level {level}" if level else "it claims no level"
    yield met("3.v", says, place) if place else not_met("3.v", "there is none")
    link = folder.says(r"quality[ _]declaration|quality level", folder.readme)
    unnamed = not_met("3.v.a", "no README names a quality declaration")
    yield met("3.v.a", "the README names it", link) if link else unnamed
    yield not_known("3.v.b", "the lists of packages by level are not part of the package")
    listed = folder.says(r"REP[- ]?2004", folder.declaration)
    unlisted = not_met("3.v.c", "no declaration refers to REP-2004")
    yield met("3.v.c", "the declaration refers to REP-2004", listed) if listed else unlisted


def _features(folder: PackageFolder) -> Item:
    docs = [one for one in (folder.folder / "doc", folder.folder / "docs") if is_folder(one)]
    if docs or folder.readme:
        places = [folder.location(one) for one in (*docs, *((folder.readme,) if folder.readme else ()))]
        return not_known("3.i", "there is documentation; whether it covers each feature needs human judgement", *places)
    return not_met("3.i", "no README and no doc folder")


def _public_items(folder: PackageFolder) -> Item:
    headers = {one.path for one in folder.public_headers()}
    items = [
        one for one in folder.entities()
        if one.path in headers and one.line and one.kind in (EntityKind.CLASS, EntityKind.FUNCTION)
    ]  # fmt: skip
    if not items:
        return not_known("3.ii", "no class or function is defined in a public header")
    lines = {path: folder.text(folder.absolute(path)).splitlines() for path in {one.path for one in items}}
    bare = [one for one in items if not _commented(lines[one.path], one.line)]
    commented = len(items) - len(bare)
    shown = f"{commented} of {len(items)} classes and functions in public headers have a comment before them"
    where = (Location(one.path, one.line) for one in bare)
    if commented < _MOST * len(items):
        return not_met("3.ii", shown, *where)
    return not_known("3.ii", f"{shown}; the others may be no part of the API", *where) if bare else met("3.ii", shown)


def _commented(lines: list[str], line: int) -> bool:
    """Return whether a comment stands before a declaration that begins in or above this line."""
    for before in reversed(lines[max(0, line - _ABOVE) : line - 1]):
        text = before.strip()
        if text.endswith("*/") or text.startswith(("//", "* ", "/*")):
            return True
        if not text or text.endswith((";", "{", "}")):
            return False
    return False


def _licence(folder: PackageFolder) -> Item:
    named = [one for one in folder.package.licenses if one.name and one.name.upper() not in ("TO" + "DO", "UNKNOWN")]
    if not named:
        return not_met("3.iii", "the manifest declares no licence", folder.package.manifest)
    names = ", ".join(one.name for one in named)
    text = folder.find("LICENSE", "LICENSE.txt", "LICENSE.md", "LICENCE", "COPYING")
    place = folder.location(text) if text else None
    more = "its text is included" if text else "its text is not in the repository"
    return (met if text else not_met)("3.iii", f"the manifest declares {names}; {more}", named[0].location, place)


def _copyright(folder: PackageFolder) -> Item:
    files = [one for one in folder.own(*_CODE) if one.size]
    without = [one for one in files if not _COPYRIGHT.search(folder.text(folder.absolute(one.path))[:_HEAD])]
    if not files:
        return not_known("3.iv", "the package has no source of its own")
    shown = f"{len(files) - len(without)} of {len(files)} source files begin with one"
    return not_met("3.iv", shown, *(Location(one.path, 1) for one in without)) if without else met("3.iv", shown)
