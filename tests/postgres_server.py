"""A server of PostgreSQL of one's own, on a socket in a folder of its own: started, killed and started again."""

from __future__ import annotations

import os
import pwd
import shutil
import signal
import subprocess
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import Any

import pytest


class PostgresServer:
    """A server that may be thrown out of, and killed with all its processes."""

    def __init__(self, programs: Path, folder: Path, who: dict[str, Any]) -> None:
        self.address = f"postgresql://roslens@/postgres?host={folder}"
        self._programs = programs
        self._folder = folder
        self._who = who

    def schema(self, name: str) -> str:
        """Return the address of a schema."""
        return f"{self.address}&schema={name}"

    def run(self, program: str, *words: str) -> None:
        """Run one of the server's programs on its data."""
        subprocess.run(
            [self._programs / program, "-D", self._folder / "data", *words], check=True, cwd=self._folder,
            stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, **self._who,
        )  # fmt: skip

    def start(self) -> None:
        """Start it, and wait until it answers."""
        options = f"-c listen_addresses='' -k {self._folder} -F"
        self.run("pg_ctl", "-w", "-l", str(self._folder / "log"), "-o", options, "start")

    def kill(self) -> None:
        """End all its processes with SIGKILL, so that nothing is written before."""
        data = self._folder / "data"
        while processes := _in_folder(data):
            for one in processes:
                with suppress(ProcessLookupError):
                    os.kill(one, signal.SIGKILL)
        # A dead process that nobody waited for yet still has its number, and the next server would take it for alive.
        for left in (data / "postmaster.pid", *self._folder.glob(".s.PGSQL.*")):
            left.unlink(missing_ok=True)

    def throw_out(self) -> None:
        """End all connections but that which asks for it."""
        import psycopg

        with psycopg.connect(self.address, autocommit=True) as connection:
            connection.execute(
                "SELECT pg_terminate_backend(pid) FROM pg_stat_activity "
                "WHERE pid <> pg_backend_pid() AND datname = 'postgres'"
            )


def _in_folder(folder: Path) -> list[int]:
    """Return the processes whose current folder this is, as that of all processes of a server is its data."""
    found = []
    for process in Path("/proc").glob("[0-9]*"):
        with suppress(OSError):
            if (process / "cwd").readlink() == folder:
                found.append(int(process.name))
    return found


def _programs() -> Path | None:
    """Return where the server's programs are; Debian has them beside the path."""
    found = shutil.which("initdb")
    places = [Path(found).resolve().parent] if found else sorted(Path("/usr/lib/postgresql").glob("*/bin"))
    return places[-1] if places else None


@contextmanager
def postgres_server() -> Iterator[PostgresServer]:
    """Lend a server that runs; a test is left out where Debian's is not installed."""
    programs = _programs()
    pytest.importorskip("psycopg", reason="psycopg is not installed")
    if programs is None:
        pytest.skip("PostgreSQL is not installed: apt-get install postgresql")
    # The server refuses to be root.
    who: dict[str, Any] = {}
    if os.geteuid() == 0:
        try:
            user = pwd.getpwnam("postgres")
        except KeyError:
            pytest.skip("there is no user `postgres` for the server to be")
        who = {"user": user.pw_uid, "group": user.pw_gid, "extra_groups": []}
    with tempfile.TemporaryDirectory(prefix="roslens-pg-") as name:
        folder = Path(name)
        folder.chmod(0o755)
        if who:
            os.chown(folder, who["user"], who["group"])
        server = PostgresServer(programs, folder, who)
        server.run("initdb", "-A", "trust", "-U", "roslens", "--no-sync", "-E", "UTF8", "--locale=C")
        server.start()
        try:
            yield server
        finally:
            with suppress(subprocess.CalledProcessError):
                server.run("pg_ctl", "-w", "-m", "immediate", "stop")
