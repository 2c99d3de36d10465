"""A place where a command is ended: a workspace that was checked and reported before, and what is left there."""

from __future__ import annotations

import contextlib
import os
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import uuid
from collections.abc import Iterator, Sequence
from pathlib import Path

MARK = "ROSLENS_TEST_OF_ENDS"
ROSLENS = [sys.executable, "-c", "import sys; from roslens.cli.entry import main; sys.exit(main())"]
PACKAGE = """<package format="3"><name>arm</name><version>1.0.0</version><description>An arm.</description>
<maintainer email="a@b.cc">A</maintainer><license>MIT</license></package>
"""
_BRANCHES = "".join(f"  if (a == {number}) return {number};\n" for number in range(30))
LONG = f"int f{{}}(int a) {{{{\n{_BRANCHES}  return 0;\n}}}}\n"
"""A function that a quality model finds fault with."""


class Place:
    """A folder of its own, where that may be made on a disk of its own, and with shared memory of its own."""

    def __init__(self, folder: Path, mount: bool) -> None:
        self.outside = folder
        self.mark = uuid.uuid4().hex
        self._holder: subprocess.Popen[bytes] | None = None
        # The name of a socket has no room for that of a folder of pytest's.
        self._temporary = Path(tempfile.mkdtemp(prefix="ends-"))
        folder.mkdir(parents=True)
        if mount:
            script = f"mount -t tmpfs -o size=64m tmpfs '{folder}' && mount -t tmpfs tmpfs /dev/shm"
            script += " && echo && exec sleep 900"
            command = ["unshare", "--mount", "--propagation", "private", "sh", "-c", script]
            self._holder = subprocess.Popen(command, stdout=subprocess.PIPE)
            assert self._holder.stdout
            assert self._holder.stdout.readline() == b"\n"

    @property
    def inside(self) -> Path:
        """The folder as the test sees it."""
        return self._below(self.outside)

    def _below(self, path: Path) -> Path:
        return Path(f"/proc/{self._holder.pid}/root{path}") if self._holder else path

    def command(self, words: Sequence[str]) -> list[str]:
        """Return a command that runs there."""
        if self._holder is None:
            return [*ROSLENS, *words]
        # The folder as it is there, and not what lies below the disk.
        enter = ["nsenter", "--mount", f"--target={self._holder.pid}", "sh", "-c", 'cd "$0" && exec "$@"']
        return [*enter, str(self.outside), *ROSLENS, *words]

    def start(self, words: Sequence[str], **more: object) -> subprocess.Popen[bytes]:
        """Start a command of roslens; all that it starts bears the mark of the place."""
        environment = {
            name: value
            for name, value in os.environ.items()
            if not name.startswith(("ROS", "AMENT", "PYTHONPATH", "COV"))
        }
        environment |= {MARK: self.mark, "TMPDIR": str(self._temporary)}
        environment |= {"ROSLENS_COUNTERS": str(self.outside / "counters"), "PYTHONDONTWRITEBYTECODE": "1"}
        return subprocess.Popen(
            self.command(words), cwd=None if self._holder else self.outside, env=environment, start_new_session=True,
            stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, **more,
        )  # fmt: skip

    def fill(self, bytes_left: int) -> None:
        """Leave so much room on the disk."""
        used = sum(path.lstat().st_blocks * 512 for path in self.inside.rglob("*"))
        self._remount((used + bytes_left) // 1024 + 4)

    def empty(self) -> None:
        """Give the disk room again."""
        self._remount(65536)

    def _remount(self, kilobytes: int) -> None:
        assert self._holder
        enter = ["nsenter", "--mount", f"--target={self._holder.pid}"]
        subprocess.run([*enter, "mount", "-o", f"remount,size={kilobytes}k", str(self.outside)], check=True)

    @property
    def has_disk(self) -> bool:
        """Whether it has a disk of its own."""
        return self._holder is not None

    def processes(self) -> set[int]:
        """Return who bears the mark and lives."""
        found = set()
        mark = f"{MARK}={self.mark}".encode()
        for entry in Path("/proc").glob("[0-9]*"):
            with contextlib.suppress(OSError):
                if mark in (entry / "environ").read_bytes().split(b"\0"):
                    state = (entry / "stat").read_text().rpartition(")")[2].split()[0]
                    found |= {int(entry.name)} if state not in "ZX" else set()
        return found

    def files(self) -> set[str]:
        """Return all files and folders, and what is in memory where that is known to be of this place."""
        found = {str(path.relative_to(self.inside)) for path in self.inside.rglob("*")}
        shared = self._below(Path("/dev/shm")) if self._holder else None
        found |= {f"/tmp/{path.relative_to(self._temporary)}" for path in self._temporary.rglob("*")}
        return found | ({f"/dev/shm/{path.name}" for path in shared.iterdir()} if shared else set())

    def close(self) -> None:
        """End all that is there, and the place."""
        for pid in self.processes():
            with contextlib.suppress(ProcessLookupError):
                os.kill(pid, signal.SIGKILL)
        if self._holder is not None:
            self._holder.kill()
            self._holder.wait()
            assert self._holder.stdout
            self._holder.stdout.close()
        shutil.rmtree(self._temporary, ignore_errors=True)


def write_workspace(folder: Path, functions: int) -> None:
    """Write a package with so many functions that are at fault."""
    (folder / "arm").mkdir(parents=True, exist_ok=True)
    (folder / "arm" / "package.xml").write_text(PACKAGE)
    (folder / "arm" / "a.cpp").write_text("".join(LONG.format(number) for number in range(functions)))
    (folder / "arm" / "b.py").write_text("def f(a):\n    return a\n")


def may_mount() -> bool:
    """Return whether this user may make mount namespaces."""
    words = ["unshare", "--mount", "--propagation", "private", "sh", "-c", "mount -t tmpfs tmpfs /dev/shm"]
    try:
        return subprocess.run(words, capture_output=True, check=False).returncode == 0
    except OSError:
        return False


def wait_for(condition, seconds: float) -> bool:
    """Return whether something came about in time."""
    end = time.monotonic() + seconds
    while not condition():
        if time.monotonic() > end:
            return False
        time.sleep(0.02)
    return True


@contextlib.contextmanager
def place(folder: Path, *, mount: bool) -> Iterator[Place]:
    """Have a place, and nothing of it afterwards."""
    made = Place(folder, mount)
    try:
        yield made
    finally:
        made.close()
