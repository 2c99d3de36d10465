"""Real servers of git on the loopback: Debian's `git http-backend` behind a small web server, and `sshd`."""

from __future__ import annotations

import base64
import contextlib
import os
import pwd
import shutil
import socket
import subprocess
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path

import pytest


class GitWeb(ThreadingHTTPServer):
    """Hands requests to `git http-backend`.

    Attributes:
        password: that the user ``robot`` has to give; empty for nobody.
        refuse: how many of the next requests are answered with 503.
        asked: path and query of each request.
    """

    daemon_threads = True

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.password = ""
        self.refuse = 0
        self.asked: list[str] = []
        super().__init__(("127.0.0.1", 0), _Handler)

    def url(self, name: str) -> str:
        return f"http://127.0.0.1:{self.server_address[1]}/{name}/.git"


class _Handler(BaseHTTPRequestHandler):
    server: GitWeb

    def do_GET(self) -> None:
        self._answer()

    def do_POST(self) -> None:
        self._answer()

    def log_message(self, *_words: object) -> None:
        pass

    def _answer(self) -> None:
        web = self.server
        web.asked.append(self.path)
        body = self.rfile.read(int(self.headers.get("Content-Length") or 0))
        if web.refuse:
            web.refuse -= 1
            self.send_error(503)
            return
        wanted = "Basic " + base64.b64encode(f"robot:{web.password}".encode()).decode()
        if web.password and self.headers.get("Authorization") != wanted:
            self.send_response(401)
            self.send_header("WWW-Authenticate", 'Basic realm="robots"')
            self.send_header("Content-Length", "0")
            self.end_headers()
            return
        path, _, query = self.path.partition("?")
        done = subprocess.run(
            ["git", "-c", "uploadpack.allowFilter=true", "-c", "uploadpack.allowAnySHA1InWant=true",
             "-c", "safe.directory=*", "http-backend"],
            input=body, capture_output=True, check=True,
            env={
                "PATH": os.environ["PATH"], "GIT_PROJECT_ROOT": str(web.folder), "GIT_HTTP_EXPORT_ALL": "1",
                "REQUEST_METHOD": self.command, "PATH_INFO": path, "QUERY_STRING": query,
                "CONTENT_TYPE": self.headers.get("Content-Type", ""),
                "HTTP_CONTENT_ENCODING": self.headers.get("Content-Encoding", ""),
                "GIT_PROTOCOL": self.headers.get("Git-Protocol", ""), "REMOTE_ADDR": "127.0.0.1",
            },
        )  # fmt: skip
        head, _, content = done.stdout.partition(b"\r\n\r\n")
        lines = [line.partition(": ")[::2] for line in head.decode().split("\r\n")]
        status = next((value for name, value in lines if name == "Status"), "200 OK")
        self.send_response(int(status.split()[0]))
        for name, value in lines:
            if name != "Status":
                self.send_header(name, value)
        self.send_header("Content-Length", str(len(content)))
        self.end_headers()
        with contextlib.suppress(BrokenPipeError):
            self.wfile.write(content)


@contextmanager
def git_web(folder: Path) -> Iterator[GitWeb]:
    """Lend a web server of the repositories in a folder."""
    web = GitWeb(folder)
    thread = threading.Thread(target=web.serve_forever)
    thread.start()
    try:
        yield web
    finally:
        web.shutdown()
        thread.join()
        web.server_close()


@contextmanager
def git_ssh(folder: Path) -> Iterator[tuple[str, str]]:
    """Lend a server of ssh: the beginning of its URLs, and the command by which git gets there with a key."""
    program = shutil.which("sshd") or "/usr/sbin/sshd"
    if not Path(program).exists():
        pytest.skip("sshd is not installed: apt-get install openssh-server")
    if not shutil.which("ssh"):
        pytest.skip("ssh is not installed: apt-get install openssh-client")
    folder.mkdir()
    for name in ("host", "user"):
        subprocess.run(["ssh-keygen", "-q", "-t", "ed25519", "-N", "", "-f", folder / name], check=True)
    if os.geteuid() == 0:
        # Where Debian's sshd locks its unprivileged half in.
        Path("/run/sshd").mkdir(mode=0o755, exist_ok=True)
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        port = free.getsockname()[1]
    (folder / "authorized").write_text((folder / "user.pub").read_text())
    (folder / "config").write_text(
        f"Port {port}\nListenAddress 127.0.0.1\nHostKey {folder}/host\nAuthorizedKeysFile {folder}/authorized\n"
        "StrictModes no\nUsePAM no\nPidFile none\nPasswordAuthentication no\nPermitRootLogin prohibit-password\n"
    )
    key = " ".join((folder / "host.pub").read_text().split()[:2])
    (folder / "known").write_text(f"[127.0.0.1]:{port} {key}\n")
    command = (
        f"ssh -F none -i {folder}/user -o IdentitiesOnly=yes -o BatchMode=yes -o UserKnownHostsFile={folder}/known "
        "-o StrictHostKeyChecking=yes"
    )
    user = pwd.getpwuid(os.geteuid()).pw_name
    with subprocess.Popen(
        [program, "-D", "-e", "-f", folder / "config"], stderr=subprocess.PIPE, stdin=subprocess.DEVNULL
    ) as server:
        assert server.stderr is not None
        try:
            said = b""
            while b"listening on" not in said.lower():
                line = server.stderr.readline()
                if not line:
                    pytest.fail(f"sshd does not start: {said.decode(errors='replace')}")
                said += line
            yield f"ssh://{user}@127.0.0.1:{port}", command
        finally:
            server.terminate()
            server.communicate()
