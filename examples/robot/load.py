"""How hard a node of the example robot works, and what is wrong with it: from arguments, else from the environment.

--rate HZ (ROBOT_RATE), --payload BYTES (ROBOT_PAYLOAD), --delay SECONDS of processing (ROBOT_DELAY),
--leak MB/S (ROBOT_LEAK), --burn SHARE of a core, 0 to 1 (ROBOT_BURN).
"""

import argparse
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

    def work(self):
        """What a node does in each cycle: takes its time, loses memory, keeps a core busy."""
        time.sleep(self.delay)
        if self._leak:
            self._lost.append(b"x" * int(self._leak * 1e6 / self.rate))
        rest = time.monotonic() + self._burn / self.rate
        while time.monotonic() < rest:
            pass
