"""Process 1 of a host: makes the host's own view of the machine, then buries orphans until the bed lets go of it.

Run by `hosts.py` inside fresh network, process, mount, name and IPC namespaces. It ends when its standard input does,
so that a bed which dies in any way, `kill -9` included, takes all processes of its hosts along: the kernel ends
everything in a process namespace together with its process 1.
"""

import contextlib
import os
import signal
import socket
import subprocess
import sys
from types import FrameType

DISK_SIZE = "8m"
SHARED_MEMORY_SIZE = "256m"


def _bury(signum: int, frame: FrameType | None) -> None:
    with contextlib.suppress(ChildProcessError):
        while os.waitpid(-1, os.WNOHANG)[0]:
            pass


def _mount(*arguments: str) -> None:
    subprocess.run(["mount", *arguments], check=True)


def _mount_disk(disk: str) -> None:
    """A real file system in a file, so that those who look at disks see it; in memory where the machine lets us not."""
    image = f"{disk}.image"
    with contextlib.suppress(OSError, subprocess.CalledProcessError):
        for command in (["mkfs.ext2", "-q", "-F", "-m", "0", image, DISK_SIZE], ["mount", "-o", "loop", image, disk]):
            subprocess.run(command, capture_output=True, check=True)
        return
    _mount("-t", "tmpfs", "-o", f"size={DISK_SIZE}", "disk", disk)


def main() -> None:
    """Arguments: the host's name, its hosts file, and the folder where its small disk is mounted."""
    name, hosts_file, disk = sys.argv[1:]
    socket.sethostname(name)
    _mount("-t", "proc", "proc", "/proc")
    _mount("-t", "tmpfs", "-o", f"size={SHARED_MEMORY_SIZE}", "shm", "/dev/shm")
    _mount_disk(disk)
    _mount("--bind", hosts_file, "/etc/hosts")
    signal.signal(signal.SIGCHLD, _bury)
    os.write(1, b"ready\n")
    while os.read(0, 1):
        pass


if __name__ == "__main__":
    main()
