"""Which share of the files of any clones has a place that does not parse, and why.

    python benchmarks/unparsed.py [-v] [--json FILE] FOLDER

FOLDER holds clones, one a folder. Files are found and classified as by `roslens check` with nothing configured: own
code, tests, vendored and generated files are counted apart. The cause of a file is that of its first place, judged by
text; -v lists the places. What is parsed is C, C++ and Python.
"""

from __future__ import annotations

import argparse
import json
import re
import sys
from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path
from typing import NamedTuple

from roslens.source.inventory import take_inventory
from roslens.source.parsed_file import parse_file
from roslens.source.settings import MacroSettings, WorkspaceSettings
from roslens.source.workspace.find import find_workspace

SHOWN_BYTES = 200
CAUSES = (
    ("Python", ""),
    (
        "test macros",
        r"\b(?:SCENARIO|GIVEN|WHEN|THEN|SECTION|TEST_CASE\w*|TEMPLATE_\w+|(?:TYPED_)?TEST\w*|BOOST_\w+)\s*\(",
    ),
    ("mock and matcher macros", r"\b(?:MOCK_\w+|MATCHER\w*|ACTION\w*|PARAM\w*|INSTANTIATE_\w+|REGISTER_\w+)\s*\("),
    ("assertion macros", r"\b(?:EXPECT|ASSERT|REQUIRE|CHECK)\w*\s*\("),
    ("pointer to member", r"->\*|\.\*|\w::\s*\*"),
    ("template constraint", r"enable_if|requires\b|\bconcept\b|typename\s*=|\*\s*=\s*(?:nullptr|0)\s*[,>]"),
    ("operator or conversion", r"\boperator\b"),
    ("asm or extension of a compiler", r"\basm\b|__asm|__global__|<<<|\^\{|__declspec|__attribute|_Pragma|__\w+__"),
    ("arms of #if", r"^\s*#\s*(?:if|el|endif)"),
    ("directive", r"^\s*#"),
    ("macro", r"\b[A-Z][A-Z0-9_]{2,}\b"),
    ("template", r"<[^;]*>"),
)
"""What a place is taken for, by its text and its line, the first that fits; else "other"."""


class Place(NamedTuple):
    """A place that does not parse."""

    line: int
    text: str
    written: str


class File(NamedTuple):
    """A file, and where it does not parse."""

    clone: str
    path: str
    role: str
    syntax: str
    places: tuple[Place, ...]

    @property
    def cause(self) -> str:
        """What the first place is taken for."""
        if self.syntax == "python":
            return "Python"
        first = self.places[0]
        for name, pattern in CAUSES[1:]:
            if re.search(pattern, first.written) or re.search(pattern, first.text):
                return name
        return "other"


def files_of(clone: Path) -> list[File]:
    """Return the files of a clone that can be parsed."""
    workspace = find_workspace([clone], WorkspaceSettings())
    inventory = take_inventory(workspace, WorkspaceSettings(), {})
    found = []
    for files in inventory.files.values():
        for file in files:
            if not file.language.parsed_as:
                continue
            content = Path(workspace.root, file.path).read_bytes()
            facts = parse_file(content, file.language, MacroSettings()).facts()
            lines = content.split(b"\n")
            places = tuple(
                Place(one.line, one.text, lines[min(one.line, len(lines)) - 1][:SHOWN_BYTES].decode("utf-8", "replace"))
                for one in facts.faults
            )
            found.append(File(clone.name, file.path, file.role.value, file.language.parsed_as, places))
    return found


def main() -> int:
    """Measure and print tables."""
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("folder", type=Path)
    arguments.add_argument("-v", "--verbose", action="store_true", help="list the places")
    arguments.add_argument("--jobs", type=int, default=2)
    arguments.add_argument("--json", type=Path, help="write each file with its places there, one a line")
    options = arguments.parse_args()
    clones = sorted(one for one in options.folder.iterdir() if one.is_dir())
    with ProcessPoolExecutor(options.jobs) as pool:
        files = [file for found in pool.map(files_of, clones) for file in found]
    if options.json:
        options.json.write_text("".join(json.dumps(file) + "\n" for file in files))
    for line in (*_tables(files, len(clones)), *(_places(files) if options.verbose else ())):
        sys.stdout.write(f"{line}\n")
    return 0


def _tables(files: Sequence[File], clones: int) -> Iterator[str]:
    yield f"{clones} clones"
    yield f"{'':>12} {'files':>8} {'unparsed':>9} {'share':>8} {'places':>8}"
    for role in ("own", "test", "vendored", "generated", ""):
        of_role = [file for file in files if role in ("", file.role)]
        broken = [file for file in of_role if file.places]
        share = f"{100 * len(broken) / max(1, len(of_role)):.2f} %"
        places = sum(len(file.places) for file in broken)
        yield f"{role or 'all':>12} {len(of_role):>8,} {len(broken):>9,} {share:>8} {places:>8,}"
    yield ""
    yield from _counted("files by cause", (file.cause for file in files if file.places))
    yield ""
    yield from _counted("files by clone", (file.clone for file in files if file.places))


def _counted(title: str, words: Iterable[str]) -> Iterator[str]:
    yield title
    for word, count in Counter(words).most_common():
        yield f"{count:>8,}  {word}"


def _places(files: Sequence[File]) -> Iterator[str]:
    for file in files:
        for place in file.places:
            about = f"[{file.role}; {file.cause}] {place.text} <- {place.written.strip()}"
            yield f"{file.clone}/{file.path}:{place.line} {about}"


if __name__ == "__main__":
    sys.exit(main())
