"""Landlock, by which a process gives up access to files, network and signals for itself and all that it starts.

The interface of the kernel is three system calls (``man 7 landlock``), stable since Linux 5.13; what a kernel does not
know yet is left out. There is no library in wide use for it, and none is needed.
"""

from __future__ import annotations

import ctypes
import errno
import os
import stat
import struct
import sys
from collections.abc import Iterable
from functools import cache

_CREATE_RULESET, _ADD_RULE, _RESTRICT_SELF = 444, 445, 446
_VERSION_FLAG = 1
_PATH_BENEATH = 1
_PR_SET_NO_NEW_PRIVS = 38

EXECUTE, WRITE_FILE, READ_FILE, READ_DIR = 1 << 0, 1 << 1, 1 << 2, 1 << 3
_REFER, _TRUNCATE, _IOCTL_DEVICE = 1 << 13, 1 << 14, 1 << 15
_CHANGES = sum(1 << bit for bit in range(4, 13))
"""Removing and making files, folders, links, sockets and pipes."""

_OF_FILES = EXECUTE | WRITE_FILE | READ_FILE | _TRUNCATE | _IOCTL_DEVICE
"""What a rule of a file, which is no folder, may allow."""

_ALL_BY_VERSION = {
    1: EXECUTE | WRITE_FILE | READ_FILE | READ_DIR | _CHANGES,
    2: _REFER,
    3: _TRUNCATE,
    5: _IOCTL_DEVICE,
}
_TCP = 0b11
_SCOPES = 0b11

LIST = READ_DIR
READ = READ_FILE | READ_DIR
RUN = READ | EXECUTE
WRITE = RUN | WRITE_FILE | _CHANGES | _REFER | _TRUNCATE
DEVICE = READ_FILE | WRITE_FILE | _TRUNCATE | _IOCTL_DEVICE


@cache
def landlock_version() -> int:
    """Return the version of the kernel's interface; 0 where there is none."""
    if sys.platform != "linux":
        return 0
    try:
        return max(0, _call(_CREATE_RULESET, None, 0, _VERSION_FLAG))
    except OSError:
        return 0


def restrict(rules: Iterable[tuple[str, int]], *, network: bool) -> None:
    """Give up all access to files but that of ``rules``, and signals to others; for ever.

    Args:
        rules: paths, each with what is allowed below it; what is not there is left out.
        network: whether connections by TCP stay allowed.

    Raises:
        OSError: the kernel refuses.
    """
    version = landlock_version()
    handled = sum(rights for since, rights in _ALL_BY_VERSION.items() if since <= version)
    known = 8 if version < 4 else 16 if version < 6 else 24
    attributes = struct.pack("QQQ", handled, 0 if network else _TCP, _SCOPES)[:known]
    ruleset = _call(_CREATE_RULESET, attributes, len(attributes), 0)
    try:
        for path, rights in rules:
            _allow(ruleset, path, rights & handled)
        _set_no_new_privileges()
        _call(_RESTRICT_SELF, ruleset, 0)
    finally:
        os.close(ruleset)


def _allow(ruleset: int, path: str, rights: int) -> None:
    try:
        place = os.open(path, os.O_PATH | os.O_CLOEXEC)
    except OSError:
        return
    try:
        if not stat.S_ISDIR(os.fstat(place).st_mode):
            rights &= _OF_FILES
        _call(_ADD_RULE, ruleset, _PATH_BENEATH, struct.pack("=Qi", rights, place), 0)
    finally:
        os.close(place)


def _set_no_new_privileges() -> None:
    library = ctypes.CDLL(None, use_errno=True)
    if library.prctl(_PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0):
        raise OSError(ctypes.get_errno(), "prctl")


def _call(number: int, *arguments: bytes | int | None) -> int:
    library = ctypes.CDLL(None, use_errno=True)
    given = [ctypes.c_long(one) if isinstance(one, int) else ctypes.c_char_p(one) for one in arguments]
    result = int(library.syscall(ctypes.c_long(number), *given))
    if result < 0:
        error = ctypes.get_errno()
        raise OSError(error or errno.ENOSYS, os.strerror(error))
    return result
