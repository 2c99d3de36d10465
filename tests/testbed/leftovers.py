"""Names of what a bed makes, and the removal of what beds that died have left.

Every name carries the process id of its bed. What carries the id of a process that is gone belongs to nobody.
"""

import contextlib
import os
import re
import secrets
import shutil
import signal
import subprocess
import tempfile
from pathlib import Path

NAMESPACES = Path("/run/netns")
_NAME = re.compile(r"roslens-(\d+)-[0-9a-f]{4}(-.+)?")


def new_stem() -> str:
    """The beginning of all names of one bed, `roslens-<pid>-<random>`: beds side by side do not meet."""
    return f"roslens-{os.getpid()}-{secrets.token_hex(2)}"


def namespaces(stem: str = "roslens-") -> list[str]:
    """Names of the network namespaces that begin with `stem`, sorted."""
    if not NAMESPACES.is_dir():
        return []
    return sorted(path.name for path in NAMESPACES.iterdir() if path.name.startswith(stem))


def delete_namespace(name: str) -> None:
    """Ends what still runs in a network namespace and deletes it."""
    pids = subprocess.run(["ip", "netns", "pids", name], capture_output=True, text=True, check=False).stdout.split()
    for pid in pids:
        with contextlib.suppress(ProcessLookupError):
            os.kill(int(pid), signal.SIGKILL)
    subprocess.run(["ip", "netns", "del", name], capture_output=True, check=False)


def _is_orphan(name: str) -> bool:
    match = _NAME.fullmatch(name)
    return match is not None and not Path(f"/proc/{match[1]}").exists()


def sweep() -> list[str]:
    """Removes namespaces and folders of beds whose process is gone; returns their names."""
    swept = [name for name in namespaces() if _is_orphan(name)]
    for name in swept:
        delete_namespace(name)
    for folder in sorted(Path(tempfile.gettempdir()).glob("roslens-*-*")):
        if _is_orphan(folder.name):
            shutil.rmtree(folder, ignore_errors=True)
            swept.append(str(folder))
    return swept
