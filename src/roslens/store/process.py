"""Process metrics kept with runs: written once however many runs share them, read on demand."""

from __future__ import annotations

import sqlite3
import zlib
from collections.abc import Sequence
from hashlib import blake2b

import msgspec

from roslens.model.process import RepositoryProcess
from roslens.store.encodable import encodable


def write_process(connection: sqlite3.Connection, run: int, found: Sequence[RepositoryProcess]) -> None:
    """Store the histories of repositories with a run, in their order."""
    for position, one in enumerate(found):
        content = _encoded(one)
        digest = blake2b(content, digest_size=16).hexdigest()
        connection.execute(
            "INSERT INTO process (digest, content) VALUES (?, ?) ON CONFLICT (digest) DO NOTHING",
            (digest, zlib.compress(content)),
        )
        connection.execute(
            "INSERT INTO run_process (run, position, process) SELECT ?, ?, id FROM process WHERE digest = ?",
            (run, position, digest),
        )


def read_process(connection: sqlite3.Connection, run: int) -> tuple[RepositoryProcess, ...]:
    """Return what a run keeps of the histories; nothing where a version wrote it that described it otherwise."""
    found = connection.execute(
        "SELECT process.content FROM run_process JOIN process ON process.id = run_process.process "
        "WHERE run_process.run = ? ORDER BY run_process.position",
        (run,),
    )
    decode = msgspec.json.Decoder(RepositoryProcess).decode
    try:
        return tuple(decode(zlib.decompress(row[0])) for row in found)
    except (msgspec.DecodeError, zlib.error):
        return ()


def _encoded(one: RepositoryProcess) -> bytes:
    try:
        return msgspec.json.encode(one)
    except UnicodeEncodeError:
        return msgspec.json.encode(encodable(one))
