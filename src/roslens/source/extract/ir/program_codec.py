"""Programs as the cache keeps them: by content, packed.

A program is about as large as its source; packed it takes a third of that.
"""

from __future__ import annotations

import zlib
from collections.abc import Iterable

import msgspec

from roslens.model.source import Language, Role, SourceFile
from roslens.source.extract.ir.program import Program
from roslens.source.keys import analyser_version, key_of
from roslens.source.settings import MacroSettings
from roslens.source.workspace.roles import in_folder_of_tests

_FASTEST = 1
_SMALL = 4000
"""Bytes that are not worth compressing: to begin takes longer than the rest."""
_COMPRESSED = b"\x78"
"""How the bytes of zlib begin; those of a program begin as a list of MessagePack."""
_CODE = frozenset({Language.C, Language.CPP, Language.PYTHON})
_encode = msgspec.msgpack.Encoder().encode
_decode = msgspec.msgpack.Decoder(Program).decode


def becomes_nodes(file: SourceFile) -> bool:
    """Return whether the code of a file may be that of nodes: not that in folders of tests, and of launch files.

    By its name alone a program that tries a robot out is like one that tests code.
    """
    return file.language in _CODE and (file.role is not Role.TEST or not in_folder_of_tests(file.path))


def program_keys(files: Iterable[SourceFile], macros: MacroSettings) -> dict[str, str]:
    """Return the keys of the programs of those files that may become nodes, by path.

    Equal keys mean equal programs, whatever the path.
    """
    ending = f"program:{key_of(analyser_version(), macros)}"
    return {file.path: f"{file.content_hash}:{file.language.value}:{ending}" for file in files if becomes_nodes(file)}


def pack(program: Program) -> bytes:
    """Return the bytes to keep."""
    return squeezed(_encode(program))


def unpack(kept: bytes) -> Program:
    """Return the program again.

    Raises:
        msgspec.DecodeError: these are no bytes of :func:`pack`.
    """
    return _decode(plain(kept))


def squeezed(packed: bytes) -> bytes:
    """Return a list or table of MessagePack as it is kept: what is small stays as it is."""
    return zlib.compress(packed, _FASTEST) if len(packed) > _SMALL else packed


def plain(kept: bytes) -> bytes:
    """Return the MessagePack again.

    Raises:
        msgspec.DecodeError: these are no bytes of :func:`squeezed`.
    """
    try:
        return zlib.decompress(kept) if kept[:1] == _COMPRESSED else kept
    except zlib.error as error:
        raise msgspec.DecodeError(str(error)) from error
