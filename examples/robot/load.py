"""How hard a node of the example robot works, and what is wrong with it: from arguments, else from the environment.

--rate HZ (ROBOT_RATE), --payload BYTES (ROBOT_PAYLOAD), --delay SECONDS of processing (ROBOT_DELAY),
--leak MB/S (ROBOT_LEAK), --burn SHARE of a core, 0 to 1 (ROBOT_BURN).

ROBOT_CHANGES names a file with lines such as `delay=0.1`, from which delay, leak and burn are taken while the node
runs, whenever the file is new; what is not in it is as before, and memory that leaked is given back without a leak.
"""

import argparse
import contextlib
import os
import time

KEYS = ("rate", "payload", "delay", "leak", "burn")


class Load:
    """The load of one node; what is not given is as the node says, or nothing."""

    def __init__(self, arguments, **usual):
        parser = argparse.ArgumentParser()
        for key in KEYS:
            given = os.environ.get("ROBOT_" + key.upper(), usual.get(key, 0.0))
            parser.add_argument("--" + key, type=float, default=float(given))
        chosen, _ = parser.parse_known_args(arguments)  # the rest is for ROS
        self.rate = chosen.rate
        self.payload = int(chosen.payload)
        self.delay = chosen.delay
        self._leak = chosen.leak
        self._burn = chosen.burn
        self._lost = []
        self._usual = (self.delay, self._leak, self._burn)
        self._changes = os.environ.get("ROBOT_CHANGES", "")
        self._changed = 0

    def _change(self):
        """Takes what is in the file, if that is new."""
        with contextlib.suppress(OSError, ValueError):
            changed = os.stat(self._changes).st_mtime_ns
            if changed == self._changed:
                return
            self._changed = changed
            with open(self._changes) as file:
                found = {key: float(value) for key, _, value in (line.partition("=") for line in file)}
            delay, leak, burn = self._usual
            self.delay = found.get("delay", delay)
            self._leak = found.get("leak", leak)
            self._burn = found.get("burn", burn)
            if not self._leak:
                self._lost.clear()

    def work(self):
        """What a node does in each cycle: takes its time, loses memory, keeps a core busy."""
        if self._changes:
            self._change()
        time.sleep(self.delay)
        if self._leak:
            self._lost.append(b"x" * int(self._leak * 1e6 / self.rate))
        rest = time.monotonic() + self._burn / self.rate
        while time.monotonic() < rest:
            pass
