"""What a page is asked and what it answers."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

import msgspec

from roslens.dashboard.address import PageRef
from roslens.dashboard.tables.table import Table, to_json


class Limits(msgspec.Struct, frozen=True):
    """How much a page shows; what is left out is always said.

    Attributes:
        findings: per page of a flat or filtered list.
        per_group: findings of one rule in a list of several rules.
        groups: rules in such a list.
        entities: functions and classes in a ranking.
        rows: of any other table.
        lines: of a source file.
        excerpts: whether findings carry the code around them.
    """

    findings: int = 200
    per_group: int = 8
    groups: int = 25
    entities: int = 50
    rows: int = 5000
    lines: int = 6000
    excerpts: bool = True


SERVED = Limits()
FOLDER = Limits(findings=1000, per_group=1000, groups=10_000, entities=200, rows=20_000)


class Query:
    """The query of an address; the first value of a name counts unless all are asked for."""

    def __init__(self, pairs: Iterable[tuple[str, str]] = ()) -> None:
        """Take (name, value) pairs in order."""
        self.pairs = tuple(pairs)

    def get(self, name: str, default: str = "") -> str:
        """Return the first value of ``name``."""
        return next((value for key, value in self.pairs if key == name), default)

    def all(self, name: str) -> tuple[str, ...]:
        """Return every non-empty value of ``name``, each also split at commas, without repeats."""
        found = (part.strip() for key, value in self.pairs if key == name for part in value.split(","))
        return tuple(dict.fromkeys(part for part in found if part))

    def number(self, name: str, default: int = 0) -> int:
        """Return a whole number that is not negative; ``default`` where the value is none."""
        text = self.get(name)
        return int(text) if text.isascii() and text.isdigit() and len(text) < 10 else default

    def replaced(self, **values: str) -> tuple[tuple[str, str], ...]:
        """Return the pairs with these names set anew; an empty value takes the name away."""
        kept = [(key, value) for key, value in self.pairs if key not in values and value]
        return (*kept, *((key, value) for key, value in values.items() if value))


class Request(msgspec.Struct, frozen=True):
    """What is asked of a page: which one of its kind, the query, how much, and for which medium.

    ``medium`` is served, folder or file. ``complete`` asks for whole tables, as the CSV twin does.
    """

    key: str = ""
    query: Query = Query()
    limits: Limits = SERVED
    medium: str = "served"
    complete: bool = False


class View(msgspec.Struct, frozen=True):
    """What a page answers.

    Attributes:
        ref: the page.
        title: its heading and window title.
        facts: what its JSON twin holds besides the tables; builtins only.
        tables: by whose names the template finds them.
        shown: what only the template needs.
        whole: the tables of the CSV twins, where they come with the page; else they are asked for on their own.
    """

    ref: PageRef
    title: str
    facts: Mapping[str, object]
    tables: tuple[Table, ...] = ()
    shown: Mapping[str, object] = {}
    whole: tuple[Table, ...] = ()

    def table(self, name: str) -> Table:
        """Return the table of that name."""
        return next(table for table in self.tables if table.name == name)

    def to_json(self, run: Mapping[str, object]) -> bytes:
        """Return the JSON twin: page, key, title, run, facts and tables."""
        content: dict[str, object] = {"page": self.ref.page, "key": self.ref.key, "title": self.title, "run": run}
        content.update(self.facts)
        content["tables"] = to_json(self.tables)
        return msgspec.json.encode(content)
