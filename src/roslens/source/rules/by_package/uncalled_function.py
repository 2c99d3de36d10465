"""Functions that nothing in a package calls: what they forget happens on no robot, and is a note."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence

import msgspec

from roslens.model.source import Language, Role
from roslens.model.weight.consequence import Certainty
from roslens.source.rules.hit import Hit
from roslens.source.rules.package_view import PackageView

_RULE = "cpp.missing_return"
_NAME = re.compile(r"(?:^|[\s:*&])(\w+)\s*\(")
_ROLES = (Role.OWN, Role.TEST, Role.VENDORED)
_MOST = 2
"""A declaration and a definition."""


def as_notes_where_uncalled(placed: Mapping[str, Sequence[Hit]], view: PackageView) -> dict[str, list[Hit]]:
    """Return hits by path; a forgotten ``return`` is a note in a function whose name stands nowhere else.

    A function of a header that is installed may be called by other packages, and one that overrides another is called
    by that one's name.

    Args:
        placed: hits of rules in the files of a package.
        view: the package.
    """
    found = {path: list(hits) for path, hits in placed.items()}
    if not any(hit.rule == _RULE for hits in found.values() for hit in hits):
        return found
    files = view.of_language(Language.C, Language.CPP, roles=_ROLES)
    texts = [view.read(file.path) for file in files]
    public = [text for file, text in zip(files, texts, strict=True) if _is_public(file.path, view)]
    for path, hits in found.items():
        found[path] = [
            msgspec.structs.replace(hit, certainty=Certainty.HEURISTIC) if _is_uncalled(hit, texts, public) else hit
            for hit in hits
        ]
    return found


def _is_public(path: str, view: PackageView) -> bool:
    """Return whether other packages may include a file: it lies below ``include``, which is installed."""
    return view.inside(path).startswith("include/") and any(
        "include" in word for one in view.cmake.named("install") for word in one.words
    )


def _is_uncalled(hit: Hit, texts: Sequence[bytes], public: Sequence[bytes]) -> bool:
    match = _NAME.search(hit.context) if hit.rule == _RULE else None
    if match is None:
        return False
    name = re.escape(match[1].encode())
    word = re.compile(rb"\b%b\b" % name)
    overrides = re.compile(rb"\bvirtual\b[^;{]*\b%b\b|\b%b\b[^;{]*\boverride\b" % (name, name))
    if any(map(word.search, public)) or any(map(overrides.search, texts)):
        return False
    return sum(len(word.findall(text)) for text in texts) <= _MOST
