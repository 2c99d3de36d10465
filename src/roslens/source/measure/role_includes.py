"""Includes and imports that indicate the role of a package: it accesses a device, or commands a robot."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from functools import lru_cache
from pathlib import Path

import msgspec

from roslens.model.result import RoleInclude
from roslens.model.source import Role, SourceFile
from roslens.source.syntax.facts import FileFacts

_MOST = 3
"""How many of each kind are kept: one is enough evidence, the others show that it is no coincidence."""


class _Words(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    headers: tuple[str, ...]
    modules: frozenset[str]


@lru_cache(maxsize=1)
def _words() -> dict[str, _Words]:
    path = Path(__file__).with_suffix(".toml")
    return msgspec.toml.decode(path.read_bytes(), type=dict[str, _Words])


def role_includes(files: Iterable[tuple[SourceFile, FileFacts]], *, own: Sequence[str]) -> tuple[RoleInclude, ...]:
    """Return the includes and imports of a package's own files that indicate its role, each once, by kind.

    Args:
        files: with the facts from parsing each.
        own: names of the package's own folder of headers, or module of Python: these are no evidence.
    """
    found: dict[tuple[str, str], RoleInclude] = {}
    for file, facts in files:
        if file.role is not Role.OWN:
            continue
        for written, line in facts.includes:
            name = written.strip('<>" ')
            if name.replace("/", ".").partition(".")[0] not in own:
                for kind in _kinds(name, facts.syntax):
                    found.setdefault((kind, name), RoleInclude(kind, name, file.path, line))
    return tuple(one for kind in _words() for one in sorted(_of(found.values(), kind), key=_order)[:_MOST])


def _of(found: Iterable[RoleInclude], kind: str) -> Iterator[RoleInclude]:
    return (one for one in found if one.kind == kind)


def _order(one: RoleInclude) -> tuple[str, str]:
    return one.name, one.path


def _kinds(name: str, syntax: str) -> Iterator[str]:
    for kind, words in _words().items():
        if name.partition(".")[0] in words.modules if syntax == "python" else name.startswith(words.headers):
            yield kind
