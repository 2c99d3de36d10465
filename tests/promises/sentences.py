"""The sentences of SECURITY, and of README's *Promises*, as they stand there, each with the tests that show it.

Guarantees name their tests where they stand; ``shown_by.toml`` names those of all other sentences.
"""

from __future__ import annotations

import ast
import re
from functools import cache
from pathlib import Path
from typing import NamedTuple

ROOT = Path(__file__).parents[2]
PARTS = {
    "README: promises": ("README.md", "## Promises\n"),
    "SECURITY: what it is": ("SECURITY.md", "# Security\n"),
    "SECURITY: trust model": ("SECURITY.md", "## Trust model\n"),
    "SECURITY: guarantees": ("SECURITY.md", "## Guarantees\n"),
    "SECURITY: known limitations": ("SECURITY.md", "## Known limitations\n"),
    "SECURITY: CI on forks": ("SECURITY.md", "## CI on forks\n"),
    "SECURITY: reporting": ("SECURITY.md", "## Reporting\n"),
}
"""Parts of documents, by title: the document and the heading."""
GUARANTEES = "SECURITY: guarantees"
_TEST = re.compile(r"`(tests/[\w/.]+(?:::\w+)?)`")
_CELL = re.compile(r"(?<!\\) \|")
_END = re.compile(r"(?<=\.) (?=[A-Z`])")


class Promise(NamedTuple):
    """A sentence, and what shows that it is true.

    Attributes:
        text: as it stands there, without line breaks.
        limit: of a guarantee.
        part: where it stands, see :data:`PARTS`.
        tests: files, folders, or functions (``file::function``).
        no_claim: why no test can show it; empty where one does.
    """

    text: str
    limit: str
    part: str
    tests: tuple[str, ...]
    no_claim: str = ""


def promises() -> list[Promise]:
    """Return all of them, in order; where nothing is declared of a sentence, tests and reason are empty."""
    shown, no_claims = shown_by(), no_claim()
    found = []
    for part in PARTS:
        if part == GUARANTEES:
            found += [Promise(row[0], row[1], part, tuple(_TEST.findall(row[-1]))) for row in _rows(_text(part))]
        else:
            sentences = _sentences(part)
            found += [Promise(one, "", part, shown.get(one, ()), no_claims.get(one, "")) for one in sentences]
    return found


def shown_by() -> dict[str, tuple[str, ...]]:
    """Return the tests of sentences that do not name them where they stand."""
    return {one["text"]: tuple(one["tests"]) for one in _declared()["promise"]}


def no_claim() -> dict[str, str]:
    """Return why no test can show a sentence: it asks or assumes something, and claims nothing of roslens."""
    return {one["text"]: one["why"] for one in _declared()["no_claim"]}


def missing(test: str) -> str:
    """Return what is missing of a test: its file, its function, or tests in it; empty where all is there."""
    name, _, function = test.partition("::")
    place = ROOT / name
    files = sorted(place.glob("**/test_*.py")) if place.is_dir() else [place]
    if not files or not all(one.is_file() and one.name.startswith("test_") for one in files):
        return f"no file of tests {name}"
    functions = {one for file in files for one in _functions(file)}
    if function:
        return "" if function in functions else f"no function {function} in {name}"
    return "" if functions else f"no test in {name}"


@cache
def _functions(file: Path) -> frozenset[str]:
    """Return the tests that a file defines."""
    nodes = ast.walk(ast.parse(file.read_bytes()))
    return frozenset(one.name for one in nodes if isinstance(one, ast.FunctionDef) and one.name.startswith("test_"))


def _declared() -> dict[str, list[dict[str, object]]]:
    import tomli

    return tomli.loads(Path(__file__).with_name("shown_by.toml").read_text())


def _text(part: str) -> str:
    document, heading = PARTS[part]
    return (ROOT / document).read_text().partition(heading)[2].split("\n## ")[0]


def _sentences(part: str) -> list[str]:
    """Return the sentences of a part: of its paragraphs and points first, then the cells of its tables."""
    text = _text(part)
    lines = [line for line in text.splitlines() if not line.startswith("|")]
    blocks = re.split(r"\n\n|\n- ", "\n" + "\n".join(lines))
    words = [" ".join(block.split()).removeprefix("- ") for block in blocks if block.strip()]
    sentences = [sentence for block in words for sentence in _END.split(block)]
    for row in _rows(text):
        sentences += [f"exit code {row[0]}: {row[1]}"] if row[0].isdecimal() else _scopes(row)
    return sentences


def _scopes(row: list[str]) -> list[str]:
    return [f"{scope}: {cell}" for scope, cell in zip(("hostile", "trusted"), row, strict=True)]


def _rows(text: str) -> list[list[str]]:
    """Return the cells of the rows of a table, without its head."""
    rows = [row for row in text.splitlines() if row.startswith("| ")][2:]
    return [[cell.strip() for cell in _CELL.split(row.strip().strip("|"))] for row in rows]
