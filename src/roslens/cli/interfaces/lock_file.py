"""The lock file of interfaces: their definitions and checksums as JSON, one line each, to be committed.

It says what is promised to other programs and recordings, independent of the history of a repository.
"""

from __future__ import annotations

import json
from pathlib import Path
from typing import TYPE_CHECKING

import msgspec

from roslens.intake.bounded_file import MOST_DOCUMENT_BYTES, read_bounded
from roslens.model.errors import UsageError

if TYPE_CHECKING:
    from roslens.source.extract.interfaces.interface import Interface, Message, Value
    from roslens.source.extract.workspace.interface_state import InterfaceState

SCHEMA = "roslens-interfaces/1"
"""Name and version; within a version keys are only added."""
NAME = "interfaces.lock"
"""What such a file is called unless the user says otherwise."""


class _Locked(msgspec.Struct, frozen=True):
    path: str
    generation: int
    definition: tuple[str, ...]
    checksum: str = ""


class _Lock(msgspec.Struct, frozen=True):
    schema: str
    versions: dict[str, str]
    interfaces: dict[str, _Locked]


def lock_text(state: InterfaceState) -> str:
    """Return the lock file of interfaces."""
    locked: dict[str, _Locked] = {}
    for one in state.interfaces:
        interface = one.interface
        if interface.complete:
            definition = tuple(_lines(interface))
            entry = _Locked(one.path, interface.generation, definition, one.checksum.text)
            locked.setdefault(interface.full_name, entry)
    document = _Lock(SCHEMA, dict(sorted(state.versions.items())), locked)
    return msgspec.json.format(msgspec.json.encode(document), indent=1).decode() + "\n"


def read_lock(path: Path) -> InterfaceState:
    """Return the interfaces of a lock file.

    Raises:
        UsageError: it is none.
    """
    from roslens.source.extract.interfaces.interface import Checksum
    from roslens.source.extract.interfaces.interface_file import read_interface
    from roslens.source.extract.workspace.interface_state import InterfaceState
    from roslens.source.extract.workspace.workspace_interfaces import KnownInterface

    try:
        lock = msgspec.json.decode(read_bounded(path, MOST_DOCUMENT_BYTES), type=_Lock)
    except (OSError, ValueError, RecursionError) as error:
        raise _refused(path, str(error)) from error
    if lock.schema != SCHEMA:
        raise _refused(path, f"its schema is {lock.schema[:80]!r}")
    known = []
    for name, one in sorted(lock.interfaces.items()):
        package, kind, short = (*name.split("/"), "", "")[:3]
        if name.count("/") != 2 or kind not in ("msg", "srv", "action") or one.generation not in (1, 2):
            raise _refused(path, f"{name[:80]!r} is no name of an interface")
        content = "\n".join(one.definition).encode()
        interface, _ = read_interface(content, f"{short}.{kind}", package, one.generation)
        known.append(KnownInterface(interface, one.path, Checksum(one.checksum)))
    return InterfaceState(tuple(known), lock.versions)


def _refused(path: Path, why: str) -> UsageError:
    return UsageError(
        f"{path} is no lock file of interfaces: {why}",
        expected=f"a file that `roslens interfaces --lock {NAME}` wrote",
        advice="Write it again from the release that it stands for",
    )


def _lines(interface: Interface) -> list[str]:
    found: list[str] = []
    for number, part in enumerate(interface.parts):
        found += ["---"] if number else []
        found += _of_part(part)
    return found


def _of_part(part: Message) -> list[str]:
    constants = [f"{one.type} {one.name}={one.written}" for one in part.constants]
    fields = [
        f"{one.type.written} {one.name}" + ("" if one.default is None else f" {_written(one.default)}")
        for one in part.fields
    ]
    return constants + fields


def _written(value: Value) -> str:
    """Return a default as a definition has it."""
    if isinstance(value, tuple):
        return f"[{', '.join(_written(one) for one in value)}]"
    if isinstance(value, bool):
        return "true" if value else "false"
    return json.dumps(value, ensure_ascii=False) if isinstance(value, str) else repr(value)
