"""A bed of hosts: each has its own network, processes, name, shared memory and small disk on one machine.

A host is a named network namespace (so `ip netns` lists it) plus process, mount, name and IPC namespaces held by
`host_init.py`. Programs in one host neither see the processes nor the shared memory of another, as on real computers.
"""

import contextlib
import os
import shutil
import signal
import subprocess
import sys
import tempfile
import threading
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from types import FrameType, TracebackType
from typing import Literal

from testbed.allowed import why_not
from testbed.leftovers import delete_namespace, new_stem, sweep
from testbed.machine import BedError, system
from testbed.process import Process
from testbed.switch_control import SwitchControl

HERE = Path(__file__).parent
NETWORK = "10.77.0"
INTERFACE = "eth0"
END_LIMIT = 10.0
Link = Literal["bulk", "shaped"]


class Host:
    """One host of a bed; made by `Bed`.

    Attributes:
        name: What the host calls itself, and what others in the bed call it.
        address: IPv4 address in the bed's network.
        namespace: Name of its network namespace, for `ip netns exec`.
        folder: A folder of its own on the machine's disk: home of its programs, their logs.
        disk: A file system of 8 MB of its own, for filling.
    """

    def __init__(self, name: str, number: int, stem: str, folder: Path) -> None:
        self.name = name
        self.number = number
        self.address = f"{NETWORK}.{number}"
        self.namespace = f"{stem}-{name}"
        self.folder = folder / name
        self.disk = self.folder / "disk"
        self.processes: list[Process] = []
        self._init: subprocess.Popen[bytes] | None = None
        self.pid = 0

    def boot(self, hosts_file: Path) -> None:
        """Starts the host's process 1 in namespaces of its own."""
        self.disk.mkdir(parents=True)
        unshared = ["unshare", "--pid", "--fork", "--kill-child", "--mount", "--uts", "--ipc"]
        init = [sys.executable, "-I", "-S", str(HERE / "host_init.py"), self.name, str(hosts_file), str(self.disk)]
        self._init = subprocess.Popen(
            ["ip", "netns", "exec", self.namespace, *unshared, *init],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            start_new_session=True,
        )
        assert self._init.stdout is not None
        if self._init.stdout.readline() != b"ready\n":
            raise BedError(f"host {self.name!r} did not start: process 1 ended with {self._init.wait()}")
        unsharing = self._init.pid
        self.pid = int(Path(f"/proc/{unsharing}/task/{unsharing}/children").read_text().split()[0])

    def shut_down(self) -> None:
        """Ends all programs of the host at once."""
        if self._init is None:
            return
        for process in self.processes:
            process.kill()
        with contextlib.suppress(ProcessLookupError):
            os.kill(self.pid or self._init.pid, signal.SIGKILL)
        for pipe in (self._init.stdin, self._init.stdout):
            if pipe is not None:
                pipe.close()
        with contextlib.suppress(subprocess.TimeoutExpired):
            self._init.wait(END_LIMIT)

    def enter(self) -> list[str]:
        """The words to put before a command to run it in this host."""
        return ["nsenter", "--all", f"--target={self.pid}", f"--wd={Path.cwd()}", "--"]

    def environment(self, extra: Mapping[str, str] | None = None) -> dict[str, str]:
        """What programs in this host get: nothing of the caller's ROS or Python, home in the host's folder."""
        path = os.environ.get("PATH", "/usr/local/bin:/usr/bin:/bin")
        plain = {"PATH": path, "HOME": str(self.folder), "LANG": "C.UTF-8", "PYTHONUNBUFFERED": "1"}
        return {**plain, "PYTHONDONTWRITEBYTECODE": "1", **(extra or {})}

    def run(
        self, command: Sequence[str], env: Mapping[str, str] | None = None, *, limit: float = 30.0, check: bool = True
    ) -> subprocess.CompletedProcess[str]:
        """Runs a program in this host to its end and returns what it wrote.

        Raises:
            BedError: It ended with another code than 0 (unless `check` is false) or took over `limit` seconds.
        """
        words = " ".join(command)
        with subprocess.Popen(
            [*self.enter(), *command],
            env=self.environment(env),
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
            start_new_session=True,
        ) as running:
            try:
                out, err = running.communicate(timeout=limit)
            except BaseException as error:
                os.killpg(running.pid, signal.SIGKILL)
                if isinstance(error, subprocess.TimeoutExpired):
                    raise BedError(f"`{words}` in host {self.name!r} took over {limit} s") from None
                raise
        if check and running.returncode != 0:
            raise BedError(f"`{words}` in host {self.name!r} ended with {running.returncode}: {err.strip()!r}")
        return subprocess.CompletedProcess(command, running.returncode, out, err)

    def start(self, command: Sequence[str], env: Mapping[str, str] | None = None, *, name: str = "program") -> Process:
        """Starts a program in this host; it ends with the bed at the latest."""
        log = self.folder / f"{name}.log"
        process = Process(name, self.enter(), command, self.environment(env), log)
        self.processes.append(process)
        return process


class Bed:
    """A context manager: hosts up and joined on entry, everything gone on exit, after a failure or SIGTERM too.

    Args:
        names: Names of the hosts.
        link: "bulk" joins them by a kernel bridge (fast; loss and rate can be set), "shaped" by the user-space switch
            (delay, jitter, loss and rate can be set; about a hundred thousand frames a second).
        seed: Of the switch's random numbers.

    Raises:
        BedError: On entry, where hosts cannot be made, with the reason.
    """

    def __init__(self, names: Sequence[str], link: Link = "bulk", *, seed: int = 1) -> None:
        self.link = link
        self.stem = new_stem()
        self.folder = Path(tempfile.gettempdir()) / self.stem
        self.hosts = {name: Host(name, n, self.stem, self.folder) for n, name in enumerate(names, 1)}
        self.middle = f"{self.stem}-.middle"  # holds the bridge, so that the machine's own network stays as it is
        self.switch: SwitchControl | None = None
        self._seed = seed
        self._undo = contextlib.ExitStack()

    def __getitem__(self, name: str) -> Host:
        return self.hosts[name]

    def __iter__(self) -> Iterator[Host]:
        return iter(self.hosts.values())

    def __enter__(self) -> "Bed":
        if reason := why_not():
            raise BedError(reason)
        sweep()
        try:
            self._undo.enter_context(_ended_by_exception())
            self._build()
        except BaseException:
            self._undo.close()
            raise
        return self

    def __exit__(self, *raised: type[BaseException] | BaseException | TracebackType | None) -> None:
        self._undo.close()

    def _build(self) -> None:
        self.folder.mkdir(mode=0o755)
        self._undo.callback(shutil.rmtree, self.folder, ignore_errors=True)
        hosts_file = self.folder / "hosts"
        lines = ["127.0.0.1 localhost", *(f"{host.address} {host.name}" for host in self)]
        hosts_file.write_text("\n".join(lines) + "\n")
        for host in self:
            self._add_namespace(host.namespace)
        if self.link == "bulk":
            self._join_by_bridge()
        else:
            self._join_by_switch()
        for host in self:
            commands = [
                f"address add {host.address}/24 broadcast + dev {INTERFACE}",
                f"link set {INTERFACE} up",
                f"route add 224.0.0.0/4 dev {INTERFACE}",
            ]
            for command in commands:
                system("ip", "-n", host.namespace, *command.split())
            self._undo.callback(host.shut_down)
            host.boot(hosts_file)

    def _add_namespace(self, name: str) -> None:
        self._undo.callback(delete_namespace, name)
        system("ip", "netns", "add", name)
        quiet = "for f in /proc/sys/net/ipv6/conf/*/disable_ipv6; do echo 1 >$f; done"
        system("ip", "netns", "exec", name, "sh", "-c", quiet)
        system("ip", "-n", name, "link", "set", "lo", "up")

    def _join_by_bridge(self) -> None:
        self._add_namespace(self.middle)
        system("ip", "-n", self.middle, "link", "add", "bridge", "type", "bridge", "mcast_snooping", "0")
        system("ip", "-n", self.middle, "link", "set", "bridge", "up")
        for host in self:
            port = f"add port{host.number} type veth peer name {INTERFACE} netns {host.namespace}"
            system("ip", "-n", self.middle, "link", *port.split())
            system("ip", "-n", self.middle, "link", "set", f"port{host.number}", "master", "bridge", "up")

    def _join_by_switch(self) -> None:
        control = self.folder / "switch"
        ports = [f"{host.name}={host.namespace}" for host in self]
        command = [sys.executable, "-I", "-S", str(HERE / "switch.py"), f"--seed={self._seed}", str(control), *ports]
        switch = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, start_new_session=True)
        self._undo.callback(_end, switch)
        assert switch.stdout is not None
        if switch.stdout.readline() != b"ready\n":
            raise BedError(f"the switch did not start: it ended with {switch.wait()}")
        self.switch = SwitchControl(control)


def _end(process: subprocess.Popen[bytes]) -> None:
    process.kill()
    for pipe in (process.stdin, process.stdout):
        if pipe is not None:
            pipe.close()
    process.wait()


@contextlib.contextmanager
def _ended_by_exception() -> Iterator[None]:
    """Makes SIGTERM leave through the with statements, where nobody else has taken care of it."""
    main = threading.current_thread() is threading.main_thread()
    if not main or signal.getsignal(signal.SIGTERM) is not signal.SIG_DFL:
        yield
        return

    def leave(signum: int, frame: FrameType | None) -> None:
        raise SystemExit(128 + signum)

    signal.signal(signal.SIGTERM, leave)
    try:
        yield
    finally:
        signal.signal(signal.SIGTERM, signal.SIG_DFL)
