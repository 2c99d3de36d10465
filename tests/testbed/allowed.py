"""Whether this machine lets us make hosts, and what is missing where it does not."""

import functools
import os
import shutil
import subprocess
from pathlib import Path

PROGRAMS = {"ip": "iproute2", "tc": "iproute2", "nft": "nftables", "nsenter": "util-linux", "unshare": "util-linux"}


@functools.cache
def why_not() -> str | None:
    """The reason why no bed can be made here, or None where it can."""
    if os.geteuid() != 0:
        return "network namespaces need root; run the tests as root to include the test bed"
    for program, package in PROGRAMS.items():
        if shutil.which(program) is None:
            return f"no program {program!r} found; install {package}"
    if not Path("/dev/net/tun").exists():
        return "no /dev/net/tun found; the user-space switch needs it"
    trial = f"roslens-{os.getpid()}-0000-trial"
    made = subprocess.run(["ip", "netns", "add", trial], capture_output=True, text=True, check=False)
    if made.returncode != 0:
        return f"`ip netns add` is refused here: {made.stderr.strip()!r}"
    subprocess.run(["ip", "netns", "del", trial], capture_output=True, check=False)
    return None
