"""The sentences of README's *Promises*, and of the guarantees and limitations in SECURITY, as they stand there."""

from __future__ import annotations

import re
from pathlib import Path
from typing import NamedTuple

ROOT = Path(__file__).parents[2]
_TEST = re.compile(r"`(tests/[\w/.]+)`")


class Promise(NamedTuple):
    """A sentence, where it stands, and the tests that show it."""

    text: str
    document: str
    tests: tuple[str, ...]


def promises() -> list[Promise]:
    """Return all of them, in order; tests are empty where none is named."""
    return [*_of_readme(), *_of_security(), *_limitations()]


def shown_by() -> dict[str, tuple[str, ...]]:
    """Return the tests of sentences of README, and of limitations, which stand where there is no room for them."""
    import tomli

    table = tomli.loads(Path(__file__).with_name("shown_by.toml").read_text())
    return {one["text"]: tuple(one["tests"]) for one in table["promise"]}


def _of_readme() -> list[Promise]:
    text = (ROOT / "README.md").read_text()
    part = text[text.index("### Promises\n") :].split("\n## ")[0].split("\n", 1)[1]
    words, _, rows = part.partition("\n|")
    tests = shown_by()
    sentences = [one.strip() for one in re.split(r"(?<=[.:]) ", " ".join(words.split())) if one.strip()]
    # A row is a number and what it means; the first two are the head of the table.
    cells = [[cell.strip() for cell in row.strip(" |").split(" | ")] for row in rows.splitlines()[2:] if "|" in row]
    sentences += [f"exit code {cell[0]}: {cell[1]}" for cell in cells]
    return [Promise(one, "README.md", tests.get(one, ())) for one in sentences]


def _limitations() -> list[Promise]:
    text = (ROOT / "SECURITY.md").read_text()
    part = text[text.index("## Known limitations\n") :].split("\n## ")[0].split("\n", 1)[1]
    points = [" ".join(point.split()) for point in part.split("\n- ") if point.strip()]
    tests = shown_by()
    sentences = [one.removeprefix("- ") for point in points for one in re.split(r"(?<=\.) (?=[A-Z`])", point)]
    return [Promise(one, "SECURITY.md, known limitations", tests.get(one, ())) for one in sentences]


def _of_security() -> list[Promise]:
    text = (ROOT / "SECURITY.md").read_text()
    part = text[text.index("## Guarantees\n") :].split("\n## ")[0]
    rows = [row for row in part.splitlines() if row.startswith("| ")][2:]
    return [_row(row) for row in rows]


def _row(row: str) -> Promise:
    cells = [cell.strip() for cell in re.split(r"(?<!\\) \|", row.strip().strip("|"))]
    return Promise(cells[0], "SECURITY.md", tuple(_TEST.findall(cells[-1])))
