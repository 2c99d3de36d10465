"""The three-host robot on ROS 1: roscore on base, nodes with rospy."""

import json
import shutil
import subprocess
from collections.abc import Mapping
from functools import cache
from typing import Any

from testbed.hosts import Bed, Host
from testbed.machine import wait_until
from testbed.process import Process
from testbed.robot import Robot

PYTHON = "/usr/bin/python3"
PORT = 11311
START_LIMIT = 60.0

_CALL = """
import json, sys, xmlrpc.client
uri, method, arguments = sys.argv[1], sys.argv[2], json.loads(sys.argv[3])
code, text, value = getattr(xmlrpc.client.ServerProxy(uri), method)("/testbed", *arguments)
assert code == 1, text
print(json.dumps(value))
"""


@cache
def why_not() -> str | None:
    """The reason why ROS 1 nodes cannot run on this machine, or None where they can."""
    if shutil.which("roscore") is None:
        return "no program 'roscore' found; install Debian's ros-core or another ROS 1"
    modules = "import rospy, geometry_msgs.msg, sensor_msgs.msg, std_msgs.msg"
    tried = subprocess.run([PYTHON, "-c", modules], capture_output=True, text=True, check=False)
    if tried.returncode != 0:
        return f"{PYTHON} cannot import ROS 1: {(tried.stderr.strip() or 'no reason given').splitlines()[-1]}"
    return None


class Ros1Robot(Robot):
    """See `Robot`. With `statistics`, nodes publish /statistics about what they receive.

    Attributes:
        master: The running roscore, apart from `processes`.
    """

    generation = "ros1"

    def __init__(self, bed: Bed, *, statistics: bool = False, **options: Any) -> None:
        super().__init__(bed, **options)
        self.master: Process | None = None
        self._statistics = statistics

    def python(self) -> str:
        """Debian's: rospy lives there."""
        return PYTHON

    @property
    def master_uri(self) -> str:
        """Where the master answers within the bed."""
        return f"http://{self.bed['base'].address}:{PORT}"

    def environment(self, host: Host) -> dict[str, str]:
        """Each host says its own address, and writes below its own folder."""
        return {"ROS_IP": host.address, "ROS_MASTER_URI": self.master_uri, "ROS_HOME": str(host.folder / "ros")}

    def start(self) -> None:
        """Starts the master, waits for it, starts the nodes."""
        base = self.bed["base"]
        self.master = base.start(["roscore", "-p", str(PORT)], self.environment(base), name="roscore")
        self.wait_for_master()
        if self._statistics:
            self.ask_master("setParam", "/enable_statistics", True)
        super().start()

    def stop(self) -> None:
        """Ends nodes, then the master with what it has started."""
        super().stop()
        if self.master is not None:
            self.master.stop()

    def wait_for_master(self) -> None:
        """Waits until the master knows /rosout, the last thing that roscore starts."""
        asked = [PYTHON, "-c", _CALL, self.master_uri, "lookupNode", json.dumps(["/rosout"])]
        wait_until(
            "the master answers", lambda: self.bed["base"].run(asked, check=False).returncode == 0, START_LIMIT, 0.2
        )

    def ask_master(self, method: str, *arguments: Any, host: str = "base") -> Any:
        """Calls a method of the master's XML-RPC interface from `host`; raises BedError when it fails."""
        asked = [PYTHON, "-c", _CALL, self.master_uri, method, json.dumps(arguments)]
        return json.loads(self.bed[host].run(asked).stdout)

    def publishers(self) -> Mapping[str, list[str]]:
        """Topics and the nodes that publish them, as the master's getSystemState says."""
        return dict(self.ask_master("getSystemState")[0])
