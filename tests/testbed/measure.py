"""Measures what a bed does: round trips, set versus measured delay and loss, throughput, the switch's cost per frame.

sudo PYTHONPATH=tests .venv/bin/python -m testbed.measure
"""

import json
import statistics
import sys
from typing import Any

from testbed import faults
from testbed.hosts import HERE, Bed, Host
from testbed.machine import wait_until

PROBE = [sys.executable, "-I", "-S", str(HERE / "probe.py")]


def answering(host: Host) -> None:
    """Starts the other end of the probes in `host`."""
    echo = host.start([*PROBE, "echo"], name="echo")
    wait_until("the probe answers", lambda: "ready" in echo.output(), 60)


def round_trips(source: Host, goal: Host, count: int = 200, interval: float = 0.01) -> dict[str, Any]:
    """Small datagrams from `source` to `goal` and back: {"sent", "answered", "rtt_ms"}."""
    found: dict[str, Any] = json.loads(source.run([*PROBE, "ask", goal.address, str(count), str(interval)]).stdout)
    return found


def throughput(source: Host, goal: Host, megabytes: int) -> float:
    """A stream of `megabytes` million bytes, in bit/s; raises ValueError if bytes are missing."""
    found = json.loads(source.run([*PROBE, "pour", goal.address, str(megabytes)], limit=60).stdout)
    if found["bytes"] != found["sent"]:
        raise ValueError(f"{found['sent']} bytes sent, {found['bytes']} arrived")
    return float(found["bytes"] * 8 / found["seconds"])


def _row(what: str, found: dict[str, Any]) -> None:
    trips = sorted(found["rtt_ms"])
    lost = 100 * (1 - found["answered"] / found["sent"])
    p95 = trips[int(len(trips) * 0.95)]
    _say(what, f"RTT median {statistics.median(trips):.2f} ms, p95 {p95:.2f} ms, lost {lost:.1f} %")


def _say(what: str, text: str) -> None:
    sys.stdout.write(f"{what:44} {text}\n")
    sys.stdout.flush()


def bulk() -> None:
    """The bed on a kernel bridge."""
    with Bed(["here", "there"], "bulk") as bed:
        here, there = bed
        answering(there)
        _row("bulk, nothing set", round_trips(here, there, 500))
        _say("bulk, nothing set", f"{throughput(here, there, 500) / 1e9:.1f} Gbit/s")
        with faults.loss(bed, "here", 20):
            _row("bulk, 20 % loss set", round_trips(here, there, 1000, 0.002))
        with faults.rate(bed, "here", 10e6):
            _say("bulk, 10 Mbit/s set", f"{throughput(here, there, 5) / 1e6:.2f} Mbit/s")


def shaped() -> None:
    """The bed on the user-space switch."""
    with Bed(["here", "there"], "shaped") as bed:
        here, there = bed
        assert bed.switch is not None
        answering(there)
        _row("shaped, nothing set", round_trips(here, there, 500))
        for ms, jitter, percent in ((20, 0, 0), (20, 5, 5), (100, 0, 20)):
            with faults.delay(bed, "here", ms, jitter), faults.loss(bed, "here", percent):
                _row(f"shaped, {ms} ± {jitter} ms, {percent} % one way", round_trips(here, there, 1000, 0.005))
        with faults.rate(bed, "here", 10e6):
            _say("shaped, 10 Mbit/s set", f"{throughput(here, there, 5) / 1e6:.2f} Mbit/s")
        for name, late in (("at once", 0.0), ("delayed", 20.0)):
            with faults.delay(bed, "here", late):
                before = bed.switch.state()
                bits = throughput(here, there, 100)
                after = bed.switch.state()
            frames = sum(after["hosts"][h]["received"] - before["hosts"][h]["received"] for h in bed.hosts)
            cost = (after["cpu_s"] - before["cpu_s"]) / frames * 1e6
            _say(f"shaped, a stream, frames {name}", f"{bits / 1e6:.0f} Mbit/s, {cost:.1f} us CPU a frame")


if __name__ == "__main__":
    bulk()
    shaped()
