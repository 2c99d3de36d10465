"""Which process of this host an identifier means."""

from __future__ import annotations

import os
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

_BITS = 0xFFFF
_MIDDLEWARE = b"librmw"


class Found(NamedTuple):
    """A process, what shows that it is the one, its command and its start in seconds since the epoch."""

    pid: int
    proofs: tuple[str, ...]
    command: str
    started: float


def find_process(bits: int, names: frozenset[str], proc: Path = Path("/proc")) -> Found | None:
    """Find the process whose id, as it sees it itself, ends in these 16 bits and that has a middleware loaded.

    Args:
        bits: the low 16 bits of the id.
        names: of nodes in it, without namespace, to choose among several by their command lines.
        proc: where the processes are listed.

    Returns:
        None where there is none, or several that nothing tells apart.
    """
    found = [pid for pid in _with_bits(bits, proc) if _has_middleware(proc / str(pid))]
    proofs = ["gid", "memory map"]
    if len(found) > 1:
        found = [pid for pid in found if any(f"__node:={name}" in _command(proc / str(pid)) for name in names)]
        proofs.append("command line")
    if len(found) != 1:
        return None
    folder = proc / str(found[0])
    return Found(found[0], tuple(proofs), _command(folder), _started(folder, proc))


def _with_bits(bits: int, proc: Path) -> Iterator[int]:
    for entry in proc.iterdir():
        if not entry.name.isdigit():
            continue
        try:
            status = (entry / "status").read_text("utf-8", "replace")
        except OSError:
            continue
        if _innermost(status, int(entry.name)) & _BITS == bits:
            yield int(entry.name)


def _innermost(status: str, pid: int) -> int:
    """Return the process id within its own namespace; ``pid`` if its status does not contain it."""
    for line in status.splitlines():
        # The last of the numbers is the one of the innermost namespace, which the process itself sees.
        if line.startswith("NSpid:"):
            return int(line.split()[-1])
    return pid


def _has_middleware(folder: Path) -> bool:
    try:
        return _MIDDLEWARE in (folder / "maps").read_bytes()
    except OSError:
        return False


def _command(folder: Path) -> str:
    try:
        return (folder / "cmdline").read_bytes().rstrip(b"\0").replace(b"\0", b" ").decode("utf-8", "replace")
    except OSError:
        return ""


def _started(folder: Path, proc: Path) -> float:
    try:
        ticks = int((folder / "stat").read_text("utf-8", "replace").rpartition(")")[2].split()[19])
        lines = (proc / "stat").read_text("utf-8", "replace").splitlines()
        booted = next(int(line.split()[1]) for line in lines if line.startswith("btime "))
    except (OSError, ValueError, IndexError, StopIteration):
        return 0.0
    return booted + ticks / os.sysconf("SC_CLK_TCK")
