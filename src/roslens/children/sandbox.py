"""What a foreign program may touch of the machine: programs and libraries, what it is to look at, its own scratch.

Landlock where the kernel has it, with sockets refused by seccomp; else bubblewrap where it is installed; else there is
no sandbox, which ``roslens doctor`` reports. Nothing else of the user's home is readable, nothing outside its scratch
can be written, and no file of the workspace can be started as a program.
"""

from __future__ import annotations

import os
import shutil
import site
import sys
from collections.abc import Iterable, Iterator, Mapping
from functools import cache
from pathlib import Path

import msgspec

from roslens.children.landlock import DEVICE, LIST, READ, RUN, WRITE, landlock_version, restrict
from roslens.children.no_sockets import refuse_sockets
from roslens.children.safe_path import without_current_folder

LANDLOCK, BUBBLEWRAP, NONE = "landlock", "bubblewrap", ""

_SYSTEM = ("/usr", "/bin", "/sbin", "/lib", "/lib32", "/lib64", "/libx32", "/opt", "/nix/store", "/snap")
_READABLE = (
    "/etc", "/proc/self", "/proc/cpuinfo", "/proc/filesystems", "/proc/loadavg", "/proc/meminfo", "/proc/stat",
    "/proc/sys", "/proc/version", "/sys/devices/system/cpu", "/sys/fs/cgroup",
)  # fmt: skip
"""Of ``/proc`` no more than that: environments of the user's other processes hold keys."""

_DEVICES = ("/dev/null", "/dev/zero", "/dev/full", "/dev/random", "/dev/urandom", "/dev/tty")
_PATHS_OF_USER = (
    "PYTHONPATH", "LD_LIBRARY_PATH", "AMENT_PREFIX_PATH", "CMAKE_PREFIX_PATH", "COLCON_PREFIX_PATH",
    "ROS_PACKAGE_PATH", "CPATH", "CPLUS_INCLUDE_PATH", "C_INCLUDE_PATH",
)  # fmt: skip
"""Variables in which the user names folders that programs read; a workspace does not choose them."""

GUARD = str(Path(__file__).with_name("guard"))
GUARDED, IMPORTED = "ROSLENS_GUARDED", "ROSLENS_IMPORTED"
SCRATCH_VARIABLES = ("HOME", "TMPDIR", "XDG_CACHE_HOME", "XDG_CONFIG_HOME", "XDG_DATA_HOME", "XDG_STATE_HOME")


class Sandbox(msgspec.Struct, frozen=True, omit_defaults=True):
    """What a program may touch besides the system's own programs and libraries.

    Attributes:
        read: files and folders that it may read; nothing in them may be started as a program.
        run: files and folders whose programs it may start, too.
        write: folders of its own.
        listed: folders whose names it may list without reading their files.
        network: whether it may use a network.
        guarded: the folder of which a program of Python imports no module; empty for the first that it may read.
        imported: folders in it of which it may.
    """

    read: tuple[str, ...] = ()
    run: tuple[str, ...] = ()
    write: tuple[str, ...] = ()
    listed: tuple[str, ...] = ()
    network: bool = False
    guarded: str = ""
    imported: tuple[str, ...] = ()


def text_of_sandbox(sandbox: Sandbox) -> str:
    """Return a sandbox as text, for the process that confines itself."""
    return msgspec.json.encode(sandbox).decode()


def sandbox_of_text(text: str) -> Sandbox:
    """Return the sandbox of a text, or of the file that an absolute path leads to."""
    if text.startswith(os.sep):
        opened = os.open(text, os.O_RDONLY | os.O_CLOEXEC)
        with os.fdopen(opened, "rb") as stream:
            return msgspec.json.decode(stream.read(), type=Sandbox)
    return msgspec.json.decode(text, type=Sandbox)


def environment_of(sandbox: Sandbox) -> dict[str, str]:
    """Return the variables of a program in a sandbox: its first folder to write is its home.

    A program of Python imports nothing from the folder that is guarded.
    """
    changed = dict.fromkeys(SCRATCH_VARIABLES, sandbox.write[0]) if sandbox.write else {}
    if guarded := sandbox.guarded or next(iter(sandbox.read), ""):
        before = without_current_folder(os.environ).get("PYTHONPATH", "")
        changed["PYTHONPATH"] = GUARD + (os.pathsep + before if before else "")
        changed[GUARDED] = guarded
        changed[IMPORTED] = os.pathsep.join(sandbox.imported)
    return changed


@cache
def sandbox_kind() -> str:
    """Return which sandbox there is: :data:`LANDLOCK`, :data:`BUBBLEWRAP` or :data:`NONE`."""
    if landlock_version():
        return LANDLOCK
    return BUBBLEWRAP if sys.platform == "linux" and bubblewrap() else NONE


@cache
def bubblewrap() -> str:
    """Return the path of a bubblewrap that works; empty for none."""
    import subprocess

    program = shutil.which("bwrap")
    if program is None:
        return ""
    try:
        done = subprocess.run(
            [program, "--ro-bind", "/", "/", "--unshare-net", "true"],
            check=False, capture_output=True, stdin=subprocess.DEVNULL, timeout=10, cwd=os.sep,
        )  # fmt: skip
    except (OSError, subprocess.TimeoutExpired):
        return ""
    return program if done.returncode == 0 else ""


def confine(sandbox: Sandbox) -> None:
    """Give up everything else, for this process and all that it starts.

    Raises:
        OSError: the kernel refuses.
    """
    if not landlock_version():
        return
    rules = [
        *((path, RUN) for path in _run_by(sandbox)),
        *((path, READ) for path in (*_READABLE, *sandbox.read)),
        *((path, LIST) for path in sandbox.listed),
        *((path, DEVICE) for path in _DEVICES),
        *((path, WRITE) for path in sandbox.write),
    ]
    restrict(rules, network=sandbox.network)
    if not sandbox.network:
        refuse_sockets()


def _run_by(sandbox: Sandbox) -> Iterator[str]:
    """Yield the folders whose programs may be started: none that holds what is only to be read."""
    yield from _SYSTEM
    yield from sandbox.run
    read = tuple(os.path.realpath(path) + os.sep for path in sandbox.read)
    for path in python_folders():
        real = os.path.realpath(path) + os.sep
        if not any(inside.startswith(real) for inside in read):
            yield path


def bubblewrap_words(sandbox: Sandbox) -> list[str]:
    """Return the words before a command that confine it by bubblewrap."""
    network = () if sandbox.network else ("--unshare-net",)
    words = [bubblewrap(), *network, "--unshare-ipc", "--unshare-pid", "--die-with-parent", "--new-session"]
    words += ["--dev", "/dev", "--proc", "/proc", "--tmpfs", "/tmp"]  # noqa: S108 - its own
    readable = (path for path in _READABLE if not path.startswith("/proc"))
    for path in (*_run_by(sandbox), *readable, *sandbox.read, *sandbox.listed):
        words += ["--ro-bind-try", path, path]
    for path in sandbox.write:
        words += ["--bind-try", path, path]
    return [*words, "--"]


@cache
def python_folders() -> tuple[str, ...]:
    """Return the folders of this Python, its modules and what the environment of the user adds to them."""
    found = {sys.prefix, sys.base_prefix, sys.exec_prefix, *sys.path, *folders_of_user(os.environ)}
    found |= set(program_folders(sys.executable))
    if site.ENABLE_USER_SITE:
        found.add(site.getusersitepackages())
    return _outermost(found)


def folders_of_user(environment: Mapping[str, str]) -> tuple[str, ...]:
    """Return the folders that variables of the user name for programs to read."""
    named = (place for name in _PATHS_OF_USER for place in environment.get(name, "").split(os.pathsep))
    return tuple(place for place in dict.fromkeys(named) if is_narrow(place))


def program_folders(program: str) -> tuple[str, ...]:
    """Return the folders a program is made of: those it is installed in, by its path and behind its links.

    Of a script they are also those of the program that runs it.
    """
    found: list[str] = []
    for path in dict.fromkeys((program, *_interpreter(program))):
        for place in _chain(path):
            folder = os.path.dirname(place)  # noqa: PTH120
            above = os.path.dirname(folder)  # noqa: PTH120
            found += [place, above if os.path.basename(folder) in ("bin", "sbin") and is_narrow(above) else folder]  # noqa: PTH119
    return tuple(place for place in dict.fromkeys(found) if is_narrow(place))


def is_narrow(path: str) -> bool:
    """Return whether a path is a whole one, and neither the user's home nor a folder above it."""
    if not os.path.isabs(path):  # noqa: PTH117
        return False
    real = os.path.realpath(path)
    home = os.path.realpath(os.path.expanduser("~"))  # noqa: PTH111
    return real != os.sep and not (home + os.sep).startswith(real + os.sep)


def _chain(path: str) -> list[str]:
    """Return a path and those that its links lead to, one after the other."""
    found = [path]
    while len(found) < 40 and os.path.islink(found[-1]):  # noqa: PTH114
        folder = os.path.dirname(found[-1])  # noqa: PTH120
        found.append(os.path.normpath(os.path.join(folder, os.readlink(found[-1]))))  # noqa: PTH115, PTH118
    return [*found, os.path.realpath(path)]


def _interpreter(program: str) -> tuple[str, ...]:
    try:
        opened = os.open(program, os.O_RDONLY | os.O_NONBLOCK | os.O_CLOEXEC)
    except OSError:
        return ()
    try:
        begin = os.read(opened, 512)
    except OSError:
        return ()
    finally:
        os.close(opened)
    if not begin.startswith(b"#!"):
        return ()
    words = begin[2:].split(b"\n")[0].decode("utf-8", "replace").split()
    return tuple(word for word in words[:1] if os.path.isabs(word))  # noqa: PTH117


def _outermost(paths: Iterable[str]) -> tuple[str, ...]:
    kept: list[str] = []
    for path in sorted(path for path in paths if is_narrow(path)):
        if not any(path.startswith(above.rstrip(os.sep) + os.sep) for above in kept):
            kept.append(path)
    return tuple(kept)
