"""A server of PostgreSQL for one run of the tests, on a socket in a folder of its own."""

import os
import pwd
import shutil
import subprocess
import tempfile
from pathlib import Path

import pytest


def _programs():
    """Return where the server's programs are; Debian has them beside the path."""
    found = shutil.which("initdb")
    places = [Path(found).resolve().parent] if found else sorted(Path("/usr/lib/postgresql").glob("*/bin"))
    return places[-1] if places else None


@pytest.fixture(scope="session")
def server():
    """Yield the address of a database; its server may be ended by `server_ended`."""
    programs = _programs()
    pytest.importorskip("psycopg", reason="psycopg is not installed")
    if programs is None:
        pytest.skip("PostgreSQL is not installed: apt-get install postgresql")
    # The server refuses to be root.
    other = {}
    if os.geteuid() == 0:
        try:
            other = {
                "user": pwd.getpwnam("postgres").pw_uid,
                "group": pwd.getpwnam("postgres").pw_gid,
                "extra_groups": [],
            }
        except KeyError:
            pytest.skip("there is no user `postgres` for the server to be")
    with tempfile.TemporaryDirectory(prefix="roslens-pg-") as name:
        folder = Path(name)
        folder.chmod(0o755)
        if other:
            os.chown(folder, other["user"], other["group"])
        data, log = folder / "data", folder / "log"

        def run(program, *words):
            subprocess.run(
                [programs / program, "-D", data, *words],
                check=True,
                cwd=folder,
                stdin=subprocess.DEVNULL,
                stdout=subprocess.DEVNULL,
                stderr=subprocess.DEVNULL,
                **other,
            )

        run("initdb", "-A", "trust", "-U", "roslens", "--no-sync", "-E", "UTF8", "--locale=C")
        run("pg_ctl", "-w", "-l", log, "-o", f"-c listen_addresses='' -k {folder} -F", "start")
        try:
            yield Server(f"postgresql://roslens@/postgres?host={folder}", run)
        finally:
            run("pg_ctl", "-w", "-m", "immediate", "stop")


class Server:
    """The address of a database, and a way to throw out all who use it."""

    def __init__(self, address, run):
        self.address = address
        self.run = run

    def schema(self, name):
        return f"{self.address}&schema={name}"

    def throw_out(self):
        import psycopg

        with psycopg.connect(self.address, autocommit=True) as connection:
            connection.execute(
                "SELECT pg_terminate_backend(pid) FROM pg_stat_activity "
                "WHERE pid <> pg_backend_pid() AND datname = 'postgres'"
            )
