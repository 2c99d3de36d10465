"""Public headers that a distribution deprecates, and those that the next one does not have."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence

from distribution_changes.revision import Revision
from distribution_changes.row import Row

_ENDINGS = (".h", ".hpp", ".hh")
_WARNS = re.compile(r"^\s*#\s*(?:warning|pragma\s+(?:GCC\s+warning|message))\b.*", re.MULTILINE)
_GENERATED = re.compile(r"(?:^|/)(?:test|tests|detail|impl)/")
_INCLUDE = re.compile(r'^\s*#\s*include\s*[<"]([^>"]+)[>"]', re.MULTILINE)
_SHORT = 60
"""Lines of code that a header has at most that does nothing but include another one and warn."""


def header_rows(revisions: Sequence[Revision]) -> list[Row]:
    """Return the rows; a header that comes back is none."""
    read = [_headers(one) for one in revisions]
    rows = []
    for name in sorted(set().union(*read)):
        having = [one for one, known in zip(revisions, read, strict=True) if name in known]
        removed = _removed(name, revisions, read)
        old = [
            one for one, known in zip(revisions, read, strict=True) if name in known and _is_obsolete(name, known[name])
        ]
        if not removed and not old:
            continue
        last = read[revisions.index(having[-1])]
        instead, since = _replacement(name, last, revisions, read)
        first = old[0].distro if old else ""
        rows.append(Row(name, first, removed, instead, since if since != having[0].distro else "", bool(instead)))
    return rows


def _headers(revision: Revision) -> Mapping[str, str]:
    """Return the public headers by the path that code includes."""
    places: dict[str, str] = {}
    for path in revision.paths:
        before, found, inside = path.rpartition("include/")
        public = found and (not before or before.endswith("/")) and path.endswith(_ENDINGS)
        if public and "/" in inside and not _GENERATED.search(inside) and not re.search(r"(?:^|/)tests?/", before):
            places[path] = inside
    contents = revision.read(places)
    return {places[path]: text for path, text in contents.items()}


def _removed(name: str, revisions: Sequence[Revision], read: Sequence[Mapping[str, str]]) -> str:
    has = [name in known for known in read]
    last = max(number for number, one in enumerate(has) if one)
    return revisions[last + 1].distro if last + 1 < len(revisions) else ""


def _is_obsolete(name: str, text: str) -> bool:
    """Whether a header warns whoever includes it, and does little else."""
    code = re.sub(r"/\*.*?\*/|//[^\n]*", "", text, flags=re.DOTALL)
    few = sum(bool(line.strip()) for line in code.splitlines()) <= _SHORT
    if not few or not _WARNS.search(code):
        return False
    stem = name.rpartition(".")[0].rpartition("/")[2]
    warned = " ".join(match[0] for match in _WARNS.finditer(code)).lower()
    return any(word in warned for word in ("obsolete", "deprecat", "use ", "instead", stem.lower()))


def _replacement(
    name: str, last: Mapping[str, str], revisions: Sequence[Revision], read: Sequence[Mapping[str, str]]
) -> tuple[str, str]:
    """Return the header that takes the place of another one, and the first distribution that has it."""
    stem = name.rpartition(".")[0]
    included = [one for one in _INCLUDE.findall(last[name]) if one.startswith(f"{stem.partition('/')[0]}/")]
    alone = included if len(included) == 1 and _is_obsolete(name, last[name]) else []
    for one in (f"{stem}.hpp", *alone):
        if one == name:
            continue
        having = [revision.distro for revision, known in zip(revisions, read, strict=True) if one in known]
        # The newest one has to have it: otherwise the place would only be another removed header.
        if having and having[-1] == revisions[-1].distro:
            return one, having[0]
    return "", ""
