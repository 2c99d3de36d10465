"""MD5 and type hashes of interfaces by their definitions, as roslens computes them."""

from __future__ import annotations

from functools import cache
from pathlib import Path

from roslens.source.extract.interfaces.interface import Interface
from roslens.source.extract.interfaces.interface_file import read_interface
from roslens.source.extract.interfaces.message_md5 import md5_of
from roslens.source.extract.interfaces.type_hash import type_hash


class Checksums:
    """Computes what identifies an interface on the wire.

    Args:
        generation: of ROS, 1 or 2.
        folders: with ``package/msg/Type.msg``; the first that has a file counts.
    """

    def __init__(self, generation: int, folders: tuple[Path, ...]) -> None:
        self._generation = generation
        self._folders = folders
        self._found = cache(self._read)

    def of(self, name: str) -> str:
        """Return the checksum of ``package/Type`` (ROS 1) or ``package/msg/Type``; empty where it cannot be known."""
        interface = self._found(name)
        if interface is None:
            return ""
        known = (md5_of if self._generation == 1 else type_hash)(interface, self._found)
        return known.text

    def _read(self, name: str) -> Interface | None:
        package, _, rest = name.partition("/")
        kinds = ("msg", "srv") if self._generation == 1 else (rest.partition("/")[0],)
        stem = rest.rpartition("/")[2]
        for folder in self._folders:
            for kind in kinds:
                path = folder / package / kind / f"{stem}.{kind}"
                if path.is_file():
                    return read_interface(path.read_bytes(), str(path), package, self._generation)[0]
        return None
