"""A running ROS 1 system: a master of its own, roslaunch, the observer, and what only publishers and servers tell."""

from __future__ import annotations

import os
import re
import shutil
import socket
import sys
import time
import xmlrpc.client
from contextlib import suppress
from pathlib import Path
from typing import Any
from urllib.parse import urlsplit

import msgspec

from accuracy.observing import NotThereError, kept, observe
from accuracy.processes import Processes
from accuracy.system import System
from roslens.live.adapters.child import clean_environment
from roslens.live.adapters.ros1.wire.tcpros import TcprosError, connect, decode_header, encode_header
from roslens.model.graph import Endpoint, Graph, Role

_CALLER = "/roslens_accuracy"
_WAIT_S = 5.0
_MASTER_S = 40.0
_QUIET_S = 8.0
_LIBRARY = re.compile(r'<library\s+path="([\w/-]+)"')


def why_not(system: System) -> str:
    """Return why a system cannot run here; empty where it can."""
    gone = [one for one in ("roscore", "roslaunch", *system.needs) if not (shutil.which(one) or Path(one).exists())]
    return f"not installed: {', '.join(gone)}" if gone else ""


def record(system: System, workspace: Path, folder: Path, port: int = 0) -> Graph:
    """Start a system and return its graph, with the MD5 that publishers and servers tell.

    Raises:
        NotThereError: its nodes did not come.
    """
    port = port or _free_port()
    master = f"http://127.0.0.1:{port}"
    environment = {
        **clean_environment(os.environ), "ROS_MASTER_URI": master, "ROS_IP": "127.0.0.1",
        "ROS_HOME": str(folder / "home"), "ROS_LOG_DIR": str(folder / "log"),
        "ROS_PACKAGE_PATH": os.pathsep.join([str(workspace), "/usr/share"]), "DISPLAY": "",
        # Scripts ask for python3: that of Debian, which has rospy, and no other.
        "PATH": os.pathsep.join(["/usr/bin", "/bin", os.environ.get("PATH", "")]),
    }  # fmt: skip
    environment.pop("PYTHONPATH", None)
    _executable(workspace)
    _link_libraries(workspace)
    with Processes(folder) as processes:
        processes.start(["roscore", "-p", str(port)], environment)
        _wait_for(master)
        given = [f"{name}:={value}" for name, value in system.arguments.items()]
        package, _, file = system.launch.partition("/")
        processes.start(["roslaunch", package, Path(file).name, *given], environment)
        command = [sys.executable, "-m", "roslens.live.adapters.ros1", "--master", master, "--period", "0.5"]
        try:
            # rosout is one of them.
            # What only parameters change of a graph is told every five seconds.
            graph = observe([*command, "--parameters"], {**os.environ}, system.nodes + 1, quiet_s=_QUIET_S)
        except NotThereError as error:
            raise NotThereError(f"{system.name}: {error}\n{processes.told()}") from None
        with xmlrpc.client.ServerProxy(master) as proxy:
            return _without_master(kept(_with_checksums(graph, proxy)))


def _executable(workspace: Path) -> None:
    """Make scripts run from where they lie, as they would after catkin_install_python."""
    for script in sorted(workspace.glob("*/scripts/*.py")):
        text = script.read_text()
        script.write_text(text if text.startswith("#!") else f"#!/usr/bin/python3\n{text}")
        script.chmod(0o755)


def _link_libraries(workspace: Path, libraries: Path = Path("/usr/lib")) -> None:
    """Put libraries of plug-ins beside their packages by the names that class_loader asks for.

    Debian has these names in packages for those who build; where they are not there they are made in the workspace.
    """
    for described in sorted(workspace.glob("*/nodelet_plugins.xml")):
        for asked in _LIBRARY.findall(described.read_text()):
            link = described.parent / f"{asked}.so"
            there = sorted(libraries.glob(f"*/{link.name}.*"))
            if there and not link.exists():
                link.parent.mkdir(parents=True, exist_ok=True)
                link.symlink_to(there[0])


def _free_port() -> int:
    with socket.create_server(("127.0.0.1", 0)) as server:
        port: int = server.getsockname()[1]
    return port


def _wait_for(master: str) -> None:
    end = time.monotonic() + _MASTER_S
    while time.monotonic() < end:
        with suppress(OSError, xmlrpc.client.Error):
            proxy: Any
            with xmlrpc.client.ServerProxy(master) as proxy:
                state = proxy.getSystemState(_CALLER)
            if any(name == "/rosout_agg" for name, _ in state[2][0]):
                return
        time.sleep(0.1)
    raise NotThereError("roscore does not answer")


_OF_MASTER = ("/rosdistro", "/rosversion", "/run_id", "/roslaunch/")


def _without_master(graph: Graph) -> Graph:
    """Return a graph without what is there before anything is launched."""
    parameters = {
        node: {name: value for name, value in values.items() if node or not name.startswith(_OF_MASTER)}
        for node, values in graph.parameters.items()
    }
    return Graph(
        "ros1",
        tuple(one for one in graph.nodes if one.name != "/rosout"),
        tuple(one for one in graph.endpoints if one.node != "/rosout"),
        parameters={node: values for node, values in parameters.items() if values},
    )


def _with_checksums(graph: Graph, master: Any) -> Graph:
    """Return a graph with what publishers and servers say of themselves.

    The master knows one type of a topic, that which was told first; of a subscription it holds where all publishers
    agree.
    """
    ends = []
    doubtful = set()
    for end in graph.endpoints:
        told: tuple[str, str] = ("", "")
        with suppress(OSError, TcprosError, xmlrpc.client.Error, ValueError):
            told = _service(end, master) if end.role is Role.SERVICE_SERVER else _topic(end, master)
        # A publisher of any type says * until it has a message.
        kind, md5 = ("", "") if "*" in told else told
        if kind and end.type and kind != end.type:
            doubtful.add(end.name)
        ends.append(msgspec.structs.replace(end, type=kind or end.type.replace("*", ""), hash=md5))
    ends = [
        msgspec.structs.replace(one, type="") if one.role is Role.SUBSCRIPTION and one.name in doubtful else one
        for one in ends
    ]
    return msgspec.structs.replace(graph, endpoints=tuple(ends))


def _topic(end: Endpoint, master: Any) -> tuple[str, str]:
    if end.role is not Role.PUBLISHER:
        return "", ""
    node: Any
    with xmlrpc.client.ServerProxy(master.lookupNode(_CALLER, end.node)[2]) as node:
        _, _, (_, host, port) = node.requestTopic(_CALLER, end.name, [["TCPROS"]])
    line, told = connect(str(host), int(port), end.name, _CALLER, _WAIT_S)
    line.close()
    return told.type, told.md5


def _service(end: Endpoint, master: Any) -> tuple[str, str]:
    uri = urlsplit(str(master.lookupService(_CALLER, end.name)[2]))
    with socket.create_connection((uri.hostname or "", uri.port or 0), timeout=_WAIT_S) as line:
        line.sendall(encode_header({"callerid": _CALLER, "service": end.name, "md5sum": "*", "probe": "1"}))
        size = int.from_bytes(_exactly(line, 4), "little")
        told = decode_header(_exactly(line, size))
    return told.get("type", ""), told.get("md5sum", "")


def _exactly(line: socket.socket, size: int) -> bytes:
    came = b""
    while len(came) < size:
        piece = line.recv(size - len(came))
        if not piece:
            raise TcprosError("the server hung up")
        came += piece
    return came
