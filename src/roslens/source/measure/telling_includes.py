"""Includes and imports that tell what a package is for: it reaches a device, or asks a robot to do something."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from functools import lru_cache
from pathlib import Path

import msgspec

from roslens.model.result import TellingInclude
from roslens.model.source import Role, SourceFile
from roslens.source.syntax.facts import FileFacts

_MOST = 3
"""Of each kind so many are kept: one is enough to tell, and the others show that it is no chance."""


class _Words(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    headers: tuple[str, ...]
    modules: frozenset[str]


@lru_cache(maxsize=1)
def _words() -> dict[str, _Words]:
    path = Path(__file__).with_suffix(".toml")
    return msgspec.toml.decode(path.read_bytes(), type=dict[str, _Words])


def telling_includes(
    files: Iterable[tuple[SourceFile, FileFacts]], *, own: Sequence[str]
) -> tuple[TellingInclude, ...]:
    """Return what own files of a package include or import that tells its role, each once, by kind.

    Args:
        files: with what a parse reported of each.
        own: names of the package's own folder of headers, or module of Python: they tell nothing.
    """
    found: dict[tuple[str, str], TellingInclude] = {}
    for file, facts in files:
        if file.role is not Role.OWN:
            continue
        for written, line in facts.includes:
            name = written.strip('<>" ')
            if name.replace("/", ".").partition(".")[0] not in own:
                for kind in _kinds(name, facts.syntax):
                    found.setdefault((kind, name), TellingInclude(kind, name, file.path, line))
    return tuple(one for kind in _words() for one in sorted(_of(found.values(), kind), key=_order)[:_MOST])


def _of(found: Iterable[TellingInclude], kind: str) -> Iterator[TellingInclude]:
    return (one for one in found if one.kind == kind)


def _order(one: TellingInclude) -> tuple[str, str]:
    return one.name, one.path


def _kinds(name: str, syntax: str) -> Iterator[str]:
    for kind, words in _words().items():
        if name.partition(".")[0] in words.modules if syntax == "python" else name.startswith(words.headers):
            yield kind
