"""A process gives up sockets, for itself and all that it starts: neither a network nor a service of this machine.

A filter of system calls (``man 2 seccomp``): ``socket`` fails with EACCES, and so does ``io_uring_setup``, by which
one could be made in another way. Pairs of sockets that a program makes for itself still work.
"""

from __future__ import annotations

import ctypes
import errno
import os
import platform
import struct

_PR_SET_NO_NEW_PRIVS, _PR_SET_SECCOMP = 38, 22
_MODE_FILTER = 2
_LOAD, _EQUAL, _AT_LEAST, _RETURN = 0x20, 0x15, 0x35, 0x06
_NUMBER_AT, _ARCHITECTURE_AT = 0, 4
_ALLOW, _KILL = 0x7FFF0000, 0x80000000
_REFUSE = 0x00050000 | errno.EACCES
_IO_URING_SETUP = 425
_OTHER_INTERFACE = 0x40000000
"""System calls of x86-64 with this bit are those of another interface (x32)."""

_MACHINES = {
    "x86_64": (0xC000003E, 41),
    "aarch64": (0xC00000B7, 198),
    "riscv64": (0xC00000F3, 198),
}
"""Machines, with their number in the kernel and that of ``socket``."""


def can_refuse_sockets() -> bool:
    """Return whether the numbers of this machine are known."""
    return platform.machine() in _MACHINES


def refuse_sockets() -> None:
    """Give up sockets for ever; nothing where the machine is not known.

    Raises:
        OSError: the kernel refuses.
    """
    if platform.machine() not in _MACHINES:
        return
    machine, number = _MACHINES[platform.machine()]
    program = b"".join(
        (
            _step(_LOAD, _ARCHITECTURE_AT),
            _step(_EQUAL, machine, 1, 0),
            _step(_RETURN, _KILL),
            _step(_LOAD, _NUMBER_AT),
            _step(_AT_LEAST, _OTHER_INTERFACE, 2, 0),
            _step(_EQUAL, number, 1, 0),
            _step(_EQUAL, _IO_URING_SETUP, 0, 1),
            _step(_RETURN, _REFUSE),
            _step(_RETURN, _ALLOW),
        )
    )
    held = ctypes.create_string_buffer(program)
    filled = struct.pack("HxxxxxxP", len(program) // 8, ctypes.addressof(held))
    library = ctypes.CDLL(None, use_errno=True)
    for words in ((_PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0), (_PR_SET_SECCOMP, _MODE_FILTER, filled, 0, 0)):
        if library.prctl(*(ctypes.c_char_p(one) if isinstance(one, bytes) else ctypes.c_ulong(one) for one in words)):
            error = ctypes.get_errno()
            raise OSError(error, os.strerror(error))


def _step(code: int, value: int, if_true: int = 0, if_false: int = 0) -> bytes:
    return struct.pack("HBBI", code, if_true, if_false, value)
