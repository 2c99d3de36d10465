"""A node, or a master, that runs while a test needs it."""

import subprocess
from contextlib import contextmanager


@contextmanager
def running(*command, environment):
    """Start a command, and end it: how a node of others ends is not what is tried, so one that hangs is killed."""
    process = subprocess.Popen(command, env=environment, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    try:
        yield process
    finally:
        process.terminate()
        try:
            process.wait(20)
        except subprocess.TimeoutExpired:
            process.kill()
            process.wait()
