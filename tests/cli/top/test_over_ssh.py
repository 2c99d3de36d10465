"""`roslens top` in a terminal of 80 by 24, here and at the other end of a real ssh."""

from __future__ import annotations

import fcntl
import getpass
import os
import pty
import re
import select
import shutil
import signal
import socket
import struct
import subprocess
import sys
import termios
import time
from collections.abc import Iterator
from pathlib import Path

import pytest
from dashboard.live.scripted_robot import ScriptedRobot

from roslens.dashboard.live.serving import LivePage

pytest.importorskip("textual")
ROSLENS = str(Path(sys.executable).with_name("roslens"))
SSHD = shutil.which("sshd") or "/usr/sbin/sshd"
WAIT_S = 60
COLUMNS, LINES = 80, 24
_ESCAPES = re.compile(
    r"\x1b(?:\[[0-?]*[ -/]*[@-~]|\][^\x07\x1b]*(?:\x07|\x1b\\)|P[^\x1b]*\x1b\\|[()][0-9A-B]|[=>78cDEHM])"
)


class Terminal:
    """A program in a terminal of its own, and the letters that it wrote."""

    def __init__(self, command: list[str], term: str) -> None:
        self.pid, self._end = pty.fork()
        if self.pid == 0:
            environment = {**os.environ, "TERM": term, "LANG": "C.UTF-8", "COLUMNS": "", "LINES": ""}
            environment.pop("COLUMNS")
            environment.pop("LINES")
            os.execve(command[0], command, environment)
        fcntl.ioctl(self._end, termios.TIOCSWINSZ, struct.pack("HHHH", LINES, COLUMNS, 0, 0))
        self.raw = b""

    def until(self, *texts: str) -> str:
        """Return what was written once all of these were."""
        end = time.monotonic() + WAIT_S
        while not all(text in self.text for text in texts):
            assert time.monotonic() < end, self.text[-2000:]
            self._read()
        return self.text

    @property
    def text(self) -> str:
        return _ESCAPES.sub("", self.raw.decode("utf-8", "replace"))

    def _read(self) -> bool:
        if not select.select([self._end], [], [], 0.2)[0]:
            return True
        try:
            part = os.read(self._end, 65536)
        except OSError:
            return False
        self.raw += part
        return bool(part)

    def send(self, keys: str) -> None:
        self.raw = b""
        os.write(self._end, keys.encode())

    def code(self) -> int:
        """Return the exit code, once it ended."""
        end = time.monotonic() + WAIT_S
        while self._read():
            assert time.monotonic() < end, self.text[-2000:]
        _, status = os.waitpid(self.pid, 0)
        self.pid = 0
        return os.waitstatus_to_exitcode(status)

    def close(self) -> None:
        if self.pid:
            os.kill(self.pid, signal.SIGKILL)
            os.waitpid(self.pid, 0)
        os.close(self._end)


@pytest.fixture
def address() -> Iterator[str]:
    """Return where a robot with a slow lidar is shown."""
    robot = ScriptedRobot()
    robot.rates["/scan"] = 4
    robot.run(6)
    with LivePage(robot.page.newest, detail=robot.page.detail) as live:
        yield live.url.removeprefix("http://").strip("/")


def walked(terminal: Terminal) -> None:
    """See the fault, ask for it in detail, and leave."""
    try:
        text = terminal.until("/scan", "4 Hz", "rover")
        assert "Traceback" not in text
        terminal.send("n\r")
        terminal.until("8..12 Hz")
        terminal.send("q")
        assert terminal.code() == 0
    finally:
        terminal.close()


@pytest.mark.timed
@pytest.mark.parametrize("term", ["xterm-256color", "vt100", "linux", "screen"])
def test_it_is_shown_and_ended_in_each_kind_of_terminal(address: str, term: str) -> None:
    walked(Terminal([ROSLENS, "top", address], term))


@pytest.fixture
def ssh(tmp_path: Path) -> Iterator[list[str]]:
    """Return the command that opens a terminal on this machine by a real server of its own."""
    if not (Path(SSHD).exists() and shutil.which("ssh")):
        pytest.skip("there is no ssh server (apt-get install openssh-server)")
    for name in ("host", "user"):
        subprocess.run(["ssh-keygen", "-q", "-t", "ed25519", "-N", "", "-f", tmp_path / name], check=True)
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        port = free.getsockname()[1]
    log = tmp_path / "sshd.log"
    if os.access("/run", os.W_OK):
        Path("/run/sshd").mkdir(exist_ok=True)
    server = subprocess.Popen(
        [SSHD, "-D", "-E", log, "-f", "/dev/null", "-h", tmp_path / "host", "-p", str(port),
         "-o", "ListenAddress=127.0.0.1", "-o", f"AuthorizedKeysFile={tmp_path / 'user.pub'}", "-o", "PidFile=none",
         "-o", "StrictModes=no", "-o", "PermitRootLogin=yes", "-o", "PasswordAuthentication=no"],
    )  # fmt: skip
    try:
        end = time.monotonic() + WAIT_S
        while True:
            assert server.poll() is None, log.read_text()
            with socket.socket() as asked:
                if asked.connect_ex(("127.0.0.1", port)) == 0:
                    break
            assert time.monotonic() < end, log.read_text()
        yield [
            shutil.which("ssh") or "", "-tt", "-p", str(port), "-i", str(tmp_path / "user"), "-F", "/dev/null",
            "-o", "StrictHostKeyChecking=no", "-o", f"UserKnownHostsFile={tmp_path / 'known'}",
            f"{getpass.getuser()}@127.0.0.1",
        ]  # fmt: skip
    finally:
        server.terminate()
        server.wait()


@pytest.mark.timed
@pytest.mark.parametrize("term", ["xterm-256color", "vt100"])
def test_it_is_shown_at_the_other_end_of_an_ssh(address: str, ssh: list[str], term: str) -> None:
    walked(Terminal([*ssh, f"LANG=C.UTF-8 {ROSLENS} top {address}"], term))
