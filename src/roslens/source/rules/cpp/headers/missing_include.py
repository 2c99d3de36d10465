"""Rule ``cpp.missing_include``: a header of the standard library that comes by luck."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import PurePosixPath

from roslens.model.edit import edit_at
from roslens.model.source import Language, Role
from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.hit import Hit
from roslens.source.rules.include_lines import IncludeLines, include_lines, place_for_standard
from roslens.source.rules.package_view import PackageView
from roslens.source.rules.published.standard_headers import BROUGHT_ALONG, HEADER_OF
from roslens.source.rules.rule import PackageRule
from roslens.source.syntax.comments import blank_comments

_NAME = re.compile(rb"std::(\w+)")
_HEADERS = frozenset({".h", ".hh", ".hpp", ".hxx"})


def found(view: PackageView) -> Iterator[Hit]:
    """Yield the first use of each header that is missing in a file."""
    files = view.of_language(Language.CPP, roles=(Role.OWN,))
    own: dict[str, set[str]] = {}
    for file in files:
        facts, path = view.facts.get(file.path), PurePosixPath(file.path)
        if facts is not None and path.suffix in _HEADERS:
            own.setdefault(path.stem, set()).update(name for name, _ in facts.includes)
    for file in files:
        facts, path = view.facts.get(file.path), PurePosixPath(file.path)
        if facts is None:
            continue
        included = {name for name, _ in facts.includes}
        if path.suffix not in _HEADERS and any(PurePosixPath(name.strip('<>"')).stem == path.stem for name in included):
            included |= own.get(path.stem, set())
        yield from _missing(file.path, view.read(file.path), _standard(included))


def _standard(included: set[str]) -> set[str]:
    known = {name.strip('<>"') for name in included}
    known |= {f"c{name.removesuffix('.h')}" for name in known if name.endswith(".h") and "/" not in name}
    return known | {other for name in known for other in BROUGHT_ALONG.get(name, ())}


def _missing(path: str, content: bytes, included: set[str]) -> Iterator[Hit]:
    code = blank_comments(content, "cpp")
    lines: IncludeLines | None = None
    seen: set[str] = set()
    for match in _NAME.finditer(code):
        name = match[1].decode("utf-8", "replace")
        header = HEADER_OF.get(name)
        if header is None or header in included or header in seen:
            continue
        seen.add(header)
        line = code.count(b"\n", 0, match.start()) + 1
        message = f"`std::{name}` without `<{header}>`; expected `#include <{header}>`"
        lines = lines or include_lines(content, code)
        at, text = place_for_standard(content, lines, header, own=PurePosixPath(path).stem)
        edits = (edit_at(content, at, at, text, path),) if at <= match.start() else ()
        yield Hit("cpp.missing_include", message, line, context=header, path=path, edits=edits)


RULE = PackageRule(
    id="cpp.missing_include",
    title="Header of the standard library not included",
    finds="A name of the standard library, written with `std::`, whose header neither the file nor its own "
    "header includes. Include it.",
    why="It compiles because another header happens to include it; with the next distribution that one does not.",
    consequence=Consequence.HARD_TO_MAINTAIN,
    certainty=Certainty.LIKELY,
    profiles=(
        "google",
        "paper2016",
    ),
    clauses=(
        "cpplint build/include_what_you_use",
        "paper2016 include_what_you_use",
    ),
    fix="Includes the header among those of the library, in the order of names.",
    bad="std::vector<int> numbers;\n",
    good="#include <vector>\nstd::vector<int> numbers;\n",
    found=found,
)
