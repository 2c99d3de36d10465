"""What modules of launch and launch_ros have, and what their classes take, by distribution."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache
from pathlib import Path
from typing import Any

import msgspec

DISTRIBUTIONS = ("foxy", "galactic", "humble", "iron", "jazzy", "kilted", "lyrical")
"""In order of their release."""
SUPPORTED = ("humble", "jazzy", "kilted", "lyrical")
"""Those that a workspace is taken to be for where it does not say: what none of them has is a mistake."""
TABLES = ("launch.toml", "launch_ros.toml", "launch_xml.toml", "launch_yaml.toml", "later.toml")

ACTION, SUBSTITUTION, CONDITION, HANDLER, EVENT, SOURCE, ENTITY = (
    "action", "substitution", "condition", "event handler", "event", "source", "entity",
)  # fmt: skip
"""Kinds of classes."""


class Span(msgspec.Struct, frozen=True):
    """The distributions that have something, as indices of :data:`DISTRIBUTIONS`, both included."""

    first: int
    last: int

    def has(self, distribution: str) -> bool:
        """Return whether a distribution is one of them."""
        return self.first <= DISTRIBUTIONS.index(distribution) <= self.last

    @property
    def is_supported(self) -> bool:
        """Whether a supported distribution is one of them."""
        return any(self.has(one) for one in SUPPORTED)

    @property
    def removed_in(self) -> str:
        """The first distribution without it, as people write it; empty while the newest has it."""
        return "" if self.last + 1 >= len(DISTRIBUTIONS) else DISTRIBUTIONS[self.last + 1].capitalize()


ALWAYS = Span(0, len(DISTRIBUTIONS) - 1)


class Signature(msgspec.Struct, frozen=True):
    """What the constructor of a class takes.

    Attributes:
        name: full name of the class.
        kind: one of the kinds above; empty for others.
        positional: parameters that may be given by position, in order; ``*`` is any number.
        required: parameters that every supported distribution requires.
        keywords: all parameters, inherited ones too, each with the distributions that have it.
        is_open: it takes keywords that nobody can list.
    """

    name: str
    kind: str
    positional: tuple[str, ...]
    required: tuple[str, ...]
    keywords: Mapping[str, Span]
    is_open: bool

    @property
    def known(self) -> tuple[str, ...]:
        """The parameters that a supported distribution has."""
        return tuple(one for one, span in self.keywords.items() if span.is_supported)


def span(written: str) -> Span:
    """Return the span that a table writes as ``first-last``."""
    first, _, last = written.partition("-")
    return Span(
        DISTRIBUTIONS.index(first) if first else 0, DISTRIBUTIONS.index(last) if last else len(DISTRIBUTIONS) - 1
    )


class Tables(msgspec.Struct, frozen=True):
    """All tables as one.

    Attributes:
        library: the modules of the libraries, with the distributions that have them.
        modules: the names of each package of them.
        classes: by their public full names, and by those under which they are defined.
    """

    library: Mapping[str, Span]
    modules: Mapping[str, Mapping[str, Span]]
    classes: Mapping[str, Signature]


@cache
def read_tables() -> Tables:
    """Return what the tables say."""
    import tomli

    library: dict[str, Span] = {}
    modules: dict[str, dict[str, Span]] = {}
    rows: dict[str, dict[str, Any]] = {}
    for table in TABLES:
        read = tomli.loads(Path(__file__).with_name(table).read_text("utf-8"))
        library.update((name, span(written)) for name, written in read.get("library", {}).items())
        for module, names in read.get("modules", {}).items():
            modules.setdefault(module, {}).update((name, span(written)) for name, written in names.items())
        for name, row in read.get("classes", {}).items():
            known = rows.setdefault(name, {"at": {}})
            known.update({**row, "at": {**known["at"], **row.get("at", {})}})
    classes = {name: _signature(name, row) for name, row in rows.items()}
    defined = {str(rows[name].get("defined", name)): one for name, one in classes.items()}
    return Tables(library, modules, {**defined, **classes})


def _signature(name: str, row: Mapping[str, Any]) -> Signature:
    keywords = dict.fromkeys(row.get("keywords", ()), ALWAYS) | {one: span(at) for one, at in row["at"].items()}
    return Signature(
        name,
        row.get("kind", ""),
        tuple(row.get("positional", ())),
        tuple(row.get("required", ())),
        keywords,
        bool(row.get("open")),
    )


def signature_of(name: str) -> Signature | None:
    """Return what a class takes, by its full name; None for what is no class of the tables."""
    return read_tables().classes.get(name)


def names_of(module: str) -> Mapping[str, Span] | None:
    """Return the names that a module has; None for a module that the tables do not list."""
    return read_tables().modules.get(module)


@cache
def homes_of(name: str) -> tuple[str, ...]:
    """Return the modules that have a name in a supported distribution, those that are imported from first."""
    modules = read_tables().modules
    return tuple(module for module, names in modules.items() if name in names and names[name].is_supported)
