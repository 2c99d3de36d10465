"""Units that were evaluated before, as far as nothing changed since that they depend on.

A unit is kept with the outlines of all files and the content of those that it learned something from. Where one of them
is another, it is evaluated again; all others are known. See :mod:`roslens.source.extract.symbols.noted_table`.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from contextlib import contextmanager
from hashlib import blake2b

import msgspec

from roslens.source.extract.facts.node_facts import NodeFacts
from roslens.source.extract.ir.program_codec import plain, squeezed
from roslens.source.extract.symbols.evaluated_unit import EvaluatedUnit, UnitName
from roslens.source.extract.symbols.reached_functions import Reached
from roslens.source.keys import analyser_version, key_of
from roslens.store.cache import Cache

_MANY = 100
"""So many new units are written together: what a killed run loses at most."""


class _KeptUnit(msgspec.Struct, frozen=True, array_like=True):
    """A unit as it is kept.

    Attributes:
        outlines: a key of what every file of the workspace defines.
        files: those that something was learned from.
        contents: a key of their content.
        unit: :class:`_Unit` as MessagePack.
    """

    outlines: str
    files: tuple[str, ...]
    contents: str
    unit: bytes


class _Unit(msgspec.Struct, frozen=True, array_like=True):
    files: tuple[str, ...]
    facts: tuple[NodeFacts, ...]
    reached: tuple[tuple[str, int], ...]
    passed_on: tuple[tuple[str, int, bool], ...]


_encode = msgspec.msgpack.Encoder().encode
_decode = msgspec.msgpack.Decoder(_KeptUnit).decode
_decode_unit = msgspec.msgpack.Decoder(_Unit).decode


class KnownUnits:
    """The units of one version of ROS of a workspace."""

    def __init__(self, cache: Cache, outlines: str, contents: Mapping[str, str], version: str) -> None:
        """Know nothing yet; units are read when they are asked for.

        Args:
            cache: what earlier runs learned.
            outlines: a key of what every file of the workspace defines.
            contents: keys of the programs of files by path.
            version: of ROS for which the code is looked at.
        """
        self._cache = cache
        self._outlines = outlines
        self._contents = contents
        self._start = f"graph:unit:{key_of(analyser_version(), version)}"
        self._known: dict[UnitName, bytes] = {}
        self._new: dict[str, bytes] = {}
        self._noting: list[set[str]] = []

    def get(self, name: UnitName) -> EvaluatedUnit | None:
        """Return a unit; None where it has to be evaluated."""
        packed = self._known.get(name) or self._kept(name)
        if packed is None:
            return None
        try:
            unit = _unpacked(packed)
        except msgspec.DecodeError:
            return None  # What a damaged cache holds is made again.
        self._known[name] = packed
        self.note(unit.files)
        return unit

    @contextmanager
    def noting(self, files: set[str]) -> Iterator[None]:
        """Note the files that units depend on which are asked for or made meanwhile."""
        self._noting.append(files)
        try:
            yield
        finally:
            self._noting.pop()

    def has(self, path: str) -> bool:
        """Return whether a file has a program."""
        return path in self._contents

    @property
    def contents(self) -> Mapping[str, str]:
        """Keys of the programs of files by path."""
        return self._contents

    def content(self, path: str) -> str:
        """Return a key of the program of a file; empty where it has none."""
        return self._contents.get(path, "")

    def note(self, files: Iterable[str]) -> None:
        """Note that what is made now depends on files."""
        for one in self._noting:
            one.update(files)

    def add(self, name: UnitName, unit: EvaluatedUnit) -> None:
        """Know a unit from now on; it is kept when :meth:`keep` is called."""
        reached = tuple(sorted(unit.reached))
        passed_on = tuple((path, line, makes) for (path, line), makes in sorted(unit.reached.passed_on.items()))
        packed = squeezed(_encode(_Unit(unit.files, unit.facts, reached, passed_on)))
        self._known[name] = packed
        self.note(unit.files)
        contents = self._key(unit.files)
        if contents is not None:
            self._new[self._slot(name)] = _encode(_KeptUnit(self._outlines, unit.files, contents, packed))
        if len(self._new) >= _MANY:
            self.keep()

    def keep(self) -> None:
        """Write what is new."""
        self._cache.replace(self._new)
        self._new = {}

    def _kept(self, name: UnitName) -> bytes | None:
        slot = self._slot(name)
        packed = self._cache.get((slot,)).get(slot)
        if packed is None:
            return None
        try:
            kept = _decode(packed)
        except msgspec.DecodeError:
            return None
        if kept.outlines != self._outlines or self._key(kept.files) != kept.contents:
            return None
        return kept.unit

    def _slot(self, name: UnitName) -> str:
        return f"{self._start}:{key_of(name)}"

    def _key(self, files: Iterable[str]) -> str | None:
        """Return a key of what files contain; None where one of them is not there."""
        digest = blake2b(digest_size=16)
        for path in files:
            content = self._contents.get(path)
            if content is None:
                return None
            digest.update(content.encode())
        return digest.hexdigest()


def _unpacked(packed: bytes) -> EvaluatedUnit:
    unit = _decode_unit(plain(packed))
    reached = Reached()
    reached.update(unit.reached)
    reached.passed_on.update({(path, line): makes for path, line, makes in unit.passed_on})
    return EvaluatedUnit(unit.facts, reached, unit.files)
