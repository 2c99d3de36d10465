"""A running ROS 2 system: its packages installed, started by hand or by the launch system, and the observer."""

from __future__ import annotations

import hashlib
import os
import shlex
import shutil
import subprocess
import sys
import tempfile
from functools import cache
from pathlib import Path

from accuracy.installing import install
from accuracy.observing import NotThereError, kept, observe
from accuracy.processes import Processes
from accuracy.system import ROOT, System, folder_of
from roslens.live.adapters.child import clean_environment, ros2_command
from roslens.model.graph import Graph

_BUILDER = ROOT / "tests" / "ros" / "build_messages.py"
_LAUNCH = """
import sys
from launch import LaunchService
from launch.actions import IncludeLaunchDescription
from launch.launch_description_sources import AnyLaunchDescriptionSource
from ament_index_python.packages import get_package_share_directory
package, _, file = sys.argv[1].partition("/")
where = get_package_share_directory(package)
import glob, os
found = glob.glob(os.path.join(where, "**", file), recursive=True)[0]
service = LaunchService()
given = [tuple(one.split(":=", 1)) for one in sys.argv[2:]]
service.include_launch_description(IncludeLaunchDescription(AnyLaunchDescriptionSource(found), launch_arguments=given))
sys.exit(service.run())
"""
_REQUEST = """
import sys, rclpy
from lifecycle_msgs.msg import Transition
from lifecycle_msgs.srv import ChangeState
rclpy.init()
node = rclpy.create_node("roslens_request")
for one in sys.argv[1:]:
    name, transition = one.split()
    client = node.create_client(ChangeState, name + "/change_state")
    assert client.wait_for_service(30), one
    number = {"configure": Transition.TRANSITION_CONFIGURE, "activate": Transition.TRANSITION_ACTIVATE}[transition]
    future = client.call_async(ChangeState.Request(transition=Transition(id=number)))
    rclpy.spin_until_future_complete(node, future, timeout_sec=20)
    assert future.result().success, one
"""


def python() -> str:
    """Return the Python with rclpy: that of ``make parts``, or another that is named."""
    return os.environ.get("ROSLENS_ROS2_PYTHON") or str(ROOT / "build" / "ros2" / "bin" / "python")


def free_domain() -> int:
    """Return a domain that this process most likely has for itself."""
    return 60 + os.getpid() % 100


@cache
def _imports(*modules: str) -> bool:
    try:
        ended = subprocess.run(
            [python(), "-c", f"import {', '.join(modules)}"], env=clean_environment(os.environ), capture_output=True,
            check=False,
        )  # fmt: skip
    except OSError:
        return False
    return not ended.returncode


def why_not(system: System) -> str:
    """Return why a system cannot run here; empty where it can."""
    if not Path(python()).exists():
        return "no Python with rclpy: `make parts` makes build/ros2, or name one in $ROSLENS_ROS2_PYTHON"
    gone = [one for one in _interfaces(system) if not folder_of(one).is_dir()]
    gone += [one for one in system.needs if not _imports(one)]
    if not system.commands and not _imports("launch", "osrf_pycommon", "packaging"):
        gone.append("launch_ros")
    if _interfaces(system) and not shutil.which("g++"):
        gone.append("g++")
    return f"not there: {', '.join(gone)}" if gone else ""


_OF_LAUNCH = {
    "corpora:rcl_interfaces/composition_interfaces": ("rcl_interfaces", "service_msgs", "builtin_interfaces"),
}
"""What launch_ros imports and no wheel has."""


def _interfaces(system: System) -> dict[str, tuple[str, ...]]:
    return system.interfaces if system.commands else {**_OF_LAUNCH, **system.interfaces}


def record(system: System, workspace: Path, folder: Path, domain: int) -> Graph:
    """Start a system and return its graph with the parameters that its nodes tell.

    Raises:
        NotThereError: its nodes did not come.
    """
    prefix = folder / "install"
    paths = [str(path) for path in install(workspace, prefix, python())]
    built = [build(part, held) for part, held in _interfaces(system).items()]
    environment = {
        **clean_environment(os.environ), "ROS_DOMAIN_ID": str(domain), "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST",
        "PYTHONPATH": os.pathsep.join([*paths, *(str(one / "python") for one in built)]),
        "AMENT_PREFIX_PATH": os.pathsep.join([str(prefix), str(Path(python()).parents[1])]),
        "ROS_HOME": str(folder / "home"), "ROS_LOG_DIR": str(folder / "log"),
        "PYTHONUNBUFFERED": "1",
    }  # fmt: skip
    logs = folder / "logs"
    logs.mkdir()
    with Processes(logs) as processes:
        for command in system.commands:
            program, *words = shlex.split(command.replace("$share", str(prefix / "share")))
            processes.start([str(prefix / "lib" / program), *words], environment)
        if not system.commands:
            given = [f"{name}:={value}" for name, value in system.arguments.items()]
            processes.start([python(), "-c", _LAUNCH, system.launch, *given], environment)
        try:
            if system.requests:
                _request(system, environment)
            watching = ros2_command(python(), ["--domain", str(domain)])
            graph = observe(watching, environment, system.nodes, system.nodes - system.silent)
        except (NotThereError, subprocess.CalledProcessError) as error:
            raise NotThereError(f"{system.name}: {error}\n{processes.told()}") from None
    return _without_launcher(kept(graph))


def _request(system: System, environment: dict[str, str]) -> None:
    subprocess.run([python(), "-c", _REQUEST, *system.requests], env=environment, check=True, capture_output=True)


_LAUNCHER = ("/launch_ros_", "/roslens_request")


def _without_launcher(graph: Graph) -> Graph:
    """Return a graph without the node that the launch system makes for itself."""
    return Graph(
        "ros2",
        tuple(one for one in graph.nodes if not one.name.startswith(_LAUNCHER)),
        tuple(one for one in graph.endpoints if not one.node.startswith(_LAUNCHER)),
        parameters={node: of for node, of in graph.parameters.items() if not node.startswith(_LAUNCHER)},
    )


def build(part: str, held: tuple[str, ...]) -> Path:
    """Build a package of interfaces with the generators of the wheels, or find it built."""
    package = folder_of(part)
    files = sorted(one for kind in ("msg", "srv", "action") for one in package.glob(f"{kind}/*.{kind}"))
    parts = [one.read_bytes() for one in (_BUILDER, *files)]
    mark = hashlib.sha256(b"\0".join([python().encode(), " ".join(held).encode(), *parts])).hexdigest()[:16]
    target = ROOT / "build" / "interfaces" / f"{package.name}-{mark}"
    if target.exists():
        return target
    target.parent.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(dir=target.parent) as folder:
        made = Path(folder) / "made"
        made.mkdir()
        subprocess.run(
            [python(), str(_BUILDER), str(package), str(made), *held], env=clean_environment(os.environ), check=True,
            stdout=sys.stderr,
        )  # fmt: skip
        made.rename(target)
    return target
