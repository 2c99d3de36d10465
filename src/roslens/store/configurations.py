"""Computation graphs kept with runs: written once however many runs share one, read when a page asks."""

from __future__ import annotations

import sqlite3
import zlib
from collections.abc import Sequence
from hashlib import blake2b

import msgspec

from roslens.model.judged_configuration import JudgedConfiguration
from roslens.store.encodable import encodable


def write_configurations(connection: sqlite3.Connection, run: int, found: Sequence[JudgedConfiguration]) -> None:
    """Keep configurations with a run, in their order."""
    for position, one in enumerate(found):
        name, content = _encoded(one)
        digest = blake2b(content, digest_size=16).hexdigest()
        connection.execute(
            "INSERT INTO graph (digest, content) VALUES (?, ?) ON CONFLICT (digest) DO NOTHING",
            (digest, zlib.compress(content)),
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
