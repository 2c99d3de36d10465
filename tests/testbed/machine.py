"""The machine below the bed: its programs, and how they fail."""

import subprocess
import time
from collections.abc import Callable


class BedError(Exception):
    """A bed could not be made, or a program in a host failed."""


def system(*command: str) -> str:
    """Runs a program of the machine and returns what it wrote; raises BedError with its message."""
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise BedError(f"`{' '.join(command)}` ended with {done.returncode}: {done.stderr.strip()!r}")
    return done.stdout


def wait_until(what: str, condition: Callable[[], bool], limit: float, step: float = 0.05) -> float:
    """Waits until `condition()` is true and returns how long that took in seconds; raises BedError after `limit`."""
    began = time.monotonic()
    while not condition():
        if time.monotonic() - began > limit:
            raise BedError(f"waited {limit} s in vain until {what}")
        time.sleep(step)
    return time.monotonic() - began
