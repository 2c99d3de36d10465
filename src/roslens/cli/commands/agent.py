"""``roslens agent``: samples this host for a monitor elsewhere."""

from __future__ import annotations

import argparse
import platform
import signal
import sys
from pathlib import Path

from roslens.model.errors import UsageError

TEXT = "Sample this host and its ROS processes, and tell what its nodes count, for a monitor."
EXAMPLES = """\
  roslens agent --new-key ~/.roslens-key        once; copy the file to each host
  roslens agent base.local:7411 --key-file ~/.roslens-key
  roslens watch --listen 192.168.1.2:7411 --key-file ~/.roslens-key    on the host of the monitor"""

DEFAULT_PORT = 7411


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the monitor's address and the key."""
    parser.add_argument("monitor", nargs="?", metavar="HOST[:PORT]", help=f"the monitor (port {DEFAULT_PORT})")
    parser.add_argument("--key-file", type=Path, metavar="FILE", help="the key that monitor and agents share")
    parser.add_argument("--new-key", type=Path, metavar="FILE", help="write a key of 256 random bits and end")
    parser.add_argument("--make-key", dest="new_key", type=Path, metavar="FILE", help=argparse.SUPPRESS)
    parser.add_argument("--name", default=platform.node(), help="what to call this host (default: its host name)")
    parser.add_argument("--period", type=float, default=1.0, metavar="S", help="seconds between samples (default: 1)")


def run(options: argparse.Namespace) -> int:
    """Sample until interrupted or told to end.

    Raises:
        UsageError: there is no monitor or no key, or the period makes no sense.
    """
    from roslens.live.agent.key_file import read_key, write_key

    if options.new_key is not None:
        write_key(options.new_key)
        print(f"roslens: wrote {options.new_key}; copy it to each host, readable for its user alone", file=sys.stderr)
        return 0
    if options.monitor is None or options.key_file is None:
        raise UsageError(
            "no monitor" if options.monitor is None else "no key",
            expected="roslens agent HOST[:PORT] --key-file FILE",
            advice="`roslens agent --help` has examples",
        )
    if not 0.05 <= options.period <= 3600:
        raise UsageError(f"--period {options.period:g}", expected="seconds from 0.05 to 3600")
    address = address_of(options.monitor)
    _work(options, address, read_key(options.key_file))
    return 0


def address_of(text: str) -> tuple[str, int]:
    """Read ``host``, ``host:port``, ``[v6]:port`` or a bare IPv6 address.

    Raises:
        UsageError: the port is no port.
    """
    host, separator, port = text.rpartition(":")
    if not separator or text.endswith("]") or (":" in host and not host.startswith("[")):
        host, port = text, str(DEFAULT_PORT)
    if not port.isdigit() or not 0 <= int(port) < 65536 or not host:
        raise UsageError(f"{text!r} is no address", expected="HOST, HOST:PORT or [IPv6]:PORT")
    return host.strip("[]"), int(port)


def _work(options: argparse.Namespace, address: tuple[str, int], key: bytes) -> None:
    import os
    import time

    from roslens.live.agent.gpu import gpu_reader
    from roslens.live.agent.host import HostSampler
    from roslens.live.agent.identity import own_identities
    from roslens.live.agent.processes import ProcessSampler
    from roslens.live.agent.work import Agent
    from roslens.live.inside.host_counters import HostCounters

    ended: list[int] = []
    signal.signal(signal.SIGTERM, lambda number, _: ended.append(number))
    Agent(
        options.name,
        HostSampler(options.name, gpu=gpu_reader()),
        ProcessSampler(options.name),
        address=address,
        key=key,
        wall=time.time,
        steady=time.monotonic,
        period_s=options.period,
        say=lambda text: print(f"roslens agent: {text}", file=sys.stderr, flush=True),
        counters=HostCounters(options.name, os.environ),
        identities=own_identities,
    ).run(lambda: bool(ended))
