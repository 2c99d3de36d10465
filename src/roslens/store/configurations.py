"""Computation graphs kept with runs: written once however many runs share one, read when a page asks."""

from __future__ import annotations

import sqlite3
import zlib
from collections.abc import Sequence
from hashlib import blake2b

import msgspec

from roslens.model.judged_configuration import JudgedConfiguration
from roslens.store.encodable import encodable


class PackedConfiguration(msgspec.Struct, frozen=True, array_like=True):
    """A configuration as a run keeps it: under its name, with a key of its content."""

    name: str
    digest: str
    content: bytes


def packed_configuration(one: JudgedConfiguration) -> PackedConfiguration:
    """Return a configuration as a run keeps it."""
    name, content = _encoded(one)
    return PackedConfiguration(name, blake2b(content, digest_size=16).hexdigest(), zlib.compress(content))


def write_configurations(
    connection: sqlite3.Connection, run: int, found: Sequence[JudgedConfiguration | PackedConfiguration]
) -> None:
    """Keep configurations with a run, in their order."""
    for position, one in enumerate(found):
        packed = one if isinstance(one, PackedConfiguration) else packed_configuration(one)
        name, digest = packed.name, packed.digest
        connection.execute(
            "INSERT INTO graph (digest, content) VALUES (?, ?) ON CONFLICT (digest) DO NOTHING",
            (digest, packed.content),
        )
        connection.execute(
            "INSERT INTO configuration (run, position, name, graph) SELECT ?, ?, ?, id FROM graph WHERE digest = ?",
            (run, position, name, digest),
        )


def read_configurations(connection: sqlite3.Connection, run: int) -> tuple[JudgedConfiguration, ...]:
    """Return the configurations of a run; none where a version of roslens wrote them that described them otherwise."""
    found = connection.execute(
        "SELECT graph.content FROM configuration JOIN graph ON graph.id = configuration.graph "
        "WHERE configuration.run = ? ORDER BY configuration.position",
        (run,),
    )
    decode = msgspec.json.Decoder(JudgedConfiguration).decode
    try:
        return tuple(decode(zlib.decompress(row[0])) for row in found)
    except (msgspec.DecodeError, zlib.error):
        return ()


def _encoded(one: JudgedConfiguration) -> tuple[str, bytes]:
    try:
        return one.name, msgspec.json.encode(one)
    except UnicodeEncodeError:
        plain = encodable(one)
        return plain.name, msgspec.json.encode(plain)
