"""A robot of its own on this host, watched and acted upon as users do it."""

from __future__ import annotations

import os
import signal
import socket
import struct
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path

from ros2_domain import own_domain

from wrong_ok.lines import WAIT_S, Lines, Printed

ROSLENS = str(Path(sys.executable).with_name("roslens"))
HERE = Path(__file__).parent
NODES, NODES_ROS1 = HERE / "nodes.py", HERE / "nodes_ros1.py"
ALLOW = 'nodes:\n  - {name: "/**", actions: [restart, start]}\n'
OBSERVER = "roslens.live.adapters.ros2.__main__"
ROS1_PYTHON = "/usr/bin/python3"


def free_port() -> int:
    """Return a port of this host that nobody listens on."""
    with socket.create_server(("127.0.0.1", 0)) as server:
        port: int = server.getsockname()[1]
    return port


class Scene:
    """Nodes, watches and reactors of one case; all of them end with it."""

    def __init__(self, folder: Path, python: str, program: Path = NODES) -> None:
        self.folder = folder
        self.python = python
        self.program = program
        self.domain = own_domain()
        self._environment = {
            **os.environ, "HOME": str(folder), "ROS_LOG_DIR": str(folder), "ROS_DOMAIN_ID": self.domain,
            "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST", "ROSLENS_ROS2_PYTHON": python,
            "ROSLENS_COUNTERS": str(folder / "counters"),
        }  # fmt: skip
        self._read: list[Printed] = []
        self._options = ["--ros2"]

    def node(self, *role: str, counts: bool = True, **environment: str) -> Printed:
        """Start a node, by default one that counts its traffic, and wait until it is up."""
        return self._node([self.python, str(self.program), *role], counts, environment)

    def node_ros1(self, *role: str) -> Printed:
        """Start a node of ROS 1 that counts its traffic, and wait until it is up."""
        return self._node([ROS1_PYTHON, str(NODES_ROS1), *role], True, {"PYTHONPATH": ""})

    def master(self) -> Printed:
        """Start a ROS master, the one of this scene, and wait until it answers; what is watched is ROS 1 then."""
        if self._options == ["--ros2"]:
            self._environment |= {"ROS_MASTER_URI": f"http://127.0.0.1:{free_port()}", "ROS_IP": "127.0.0.1"}
            self._options = ["--ros1"]
        port = int(self._environment["ROS_MASTER_URI"].rpartition(":")[2])
        master = self._start(["rosmaster", "--core", "-p", str(port)], "master", PYTHONPATH="")
        end = time.monotonic() + WAIT_S
        while time.monotonic() < end:
            try:
                with socket.create_connection(("127.0.0.1", port), 1):
                    return master
            except ConnectionRefusedError:
                os.sched_yield()
        raise AssertionError("the ROS master does not answer")

    def key(self) -> str:
        """Return a file with the key that an agent and its monitor share."""
        path = str(self.folder / "key")
        subprocess.run([ROSLENS, "agent", "--new-key", path], check=True, capture_output=True)
        return path

    def agent(self, port: int, key: str, name: str) -> Printed:
        """Start an agent that reports to a port of this host as a host of this name."""
        return self._start([ROSLENS, "agent", f"127.0.0.1:{port}", "--key-file", key, "--name", name], "agent")

    def built(self, source: str) -> str:
        """Return the library that a C file of this folder makes."""
        library = self.folder / f"{source}.so"
        command = ["gcc", "-shared", "-fPIC", "-O1", "-o", str(library), str(HERE / f"{source}.c"), "-ldl"]
        subprocess.run(command, check=True)
        return str(library)

    def set_clocks(self, seconds: float) -> None:
        """Set the wall clock of everything that is started from now on, or was after this was first called, ahead."""
        file = self.folder / "ahead"
        if not file.exists():
            self._environment |= {"LD_PRELOAD": self.built("jumping_clock"), "WALL_CLOCK_AHEAD": str(file)}
            file.write_bytes(struct.pack("d", seconds))
        with file.open("r+b") as into:
            into.write(struct.pack("d", seconds))

    def pids(self, *words: str) -> list[int]:
        """Return the processes of this scene whose command line has these words at its end."""
        return [pid for pid, command in self._commands() if command[-len(words) :] == words]

    def observer(self) -> int:
        """Return the process that observes ROS."""
        (pid,) = (pid for pid, command in self._commands() if any(OBSERVER in one for one in command))
        return pid

    def watch(self, reference: str, *words: str, **environment: str) -> Lines:
        """Watch with a reference."""
        return self.watch_file(self._document(reference), *words, **environment)

    def watch_file(self, reference: Path, *words: str, **environment: str) -> Lines:
        """Watch with the reference in a file."""
        command = ["watch", "--reference", str(reference), *self._options, "--format", "json", *words]
        return self._lines(command, environment)

    def draft(self, seconds: float) -> Path:
        """Draft a reference from what runs for so many seconds, and return its file."""
        file = self.folder / "draft.yaml"
        words = ["reference", "draft", *self._options, "--live", f"{seconds:g} s", "-o", str(file)]
        ended = subprocess.run(
            [ROSLENS, *words], env=self._environment, cwd=self.folder, capture_output=True, text=True, check=False
        )
        assert ended.returncode == 0, ended.stderr
        return file

    def react(self, reference: str) -> Lines:
        """React to a reference, and wait until it would."""
        allow = self.folder / "allow.yaml"
        allow.write_text(ALLOW)
        allow.chmod(0o600)
        lines = self._lines(
            [
                "react", str(self._document(reference)), *self._options, "--mode", "act", "--allow", str(allow),
                "--journal", str(self.folder / "journal.jsonl"), "--cool-down", "1s", "--json",
            ],
            {},
        )  # fmt: skip
        assert lines.until(lambda line: line.get("what") == "well"), (self.folder / "react.err").read_text()
        return lines

    def refused(self, reference: str) -> str:
        """Return why a second reactor is refused; empty where it is not."""
        words = ["react", str(self._document(reference)), *self._options, "--mode", "act", "--for", "1s"]
        words += ["--journal", str(self.folder / "second.jsonl")]
        ended = subprocess.run(
            [ROSLENS, *words], env=self._environment, cwd=self.folder, capture_output=True, text=True, check=False,
            timeout=WAIT_S,
        )  # fmt: skip
        return ended.stderr if ended.returncode == 2 else ""

    def close(self) -> None:
        """End everything that was started, and what reactions started."""
        for one in reversed(self._read):
            one.process.kill()
            one.process.wait()
        for pid, _ in self._commands():
            os.kill(pid, signal.SIGKILL)
        for one in self._read:
            one.reader.join()
            if one.process.stdout is not None:
                one.process.stdout.close()

    def _commands(self) -> Iterator[tuple[int, tuple[str, ...]]]:
        """Yield the processes that were started in this scene, also by others than it, with their command lines."""
        mine = f"ROSLENS_COUNTERS={self.folder / 'counters'}\0".encode()
        for folder in Path("/proc").iterdir():
            try:
                if folder.name.isdigit() and mine in (folder / "environ").read_bytes():
                    words = (folder / "cmdline").read_text("utf-8", "replace").rstrip("\0").split("\0")
                    yield int(folder.name), tuple(words)
            except OSError:
                continue

    def _document(self, reference: str) -> Path:
        path = self.folder / f"gate{len(self._read)}.yaml"
        path.write_text(f"kind: reference\nname: gate\n{reference}")
        return path

    def _node(self, command: list[str], counts: bool, environment: dict[str, str]) -> Printed:
        node = self._start([*([ROSLENS, "run", "--"] if counts else []), *command], "nodes", **environment)
        assert node.line(WAIT_S) == "up", (self.folder / "nodes.err").read_text()
        return node

    def _lines(self, words: list[str], environment: dict[str, str]) -> Lines:
        lines = Lines(self._popen([ROSLENS, *words], words[0], environment))
        self._read.append(lines.printed)
        return lines

    def _start(self, command: list[str], errors: str, **environment: str) -> Printed:
        printed = Printed(self._popen(command, errors, environment))
        self._read.append(printed)
        return printed

    def _popen(self, command: list[str], errors: str, environment: dict[str, str]) -> subprocess.Popen[str]:
        with (self.folder / f"{errors}.err").open("a") as file:
            return subprocess.Popen(
                command, env={**self._environment, **environment}, cwd=self.folder, stdout=subprocess.PIPE,
                stderr=file, text=True,
            )  # fmt: skip
