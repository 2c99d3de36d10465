"""``roslens agent``: samples this host for a monitor elsewhere."""

from __future__ import annotations

import argparse
import contextlib
import platform
import signal
import sys
from pathlib import Path
from typing import TYPE_CHECKING

from roslens.cli.watch.agent_address import DEFAULT_PORT, DEFAULT_REQUESTS_PORT, address_of
from roslens.model.errors import UsageError

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Mapping

    from roslens.live.agent.work import Agent

TEXT = "Sample this host and its ROS processes, and send the traffic counters of its nodes to a monitor."
EXAMPLES = """\
  roslens agent --new-key ~/.roslens-key        once; copy the file to each host
  roslens agent base.local:7411 --key-file ~/.roslens-key
  roslens watch --listen 192.168.1.2:7411 --key-file ~/.roslens-key    on the host of the monitor
  roslens agent --enrol keys --name arm         on the monitor's host; copy keys/arm to the host arm, and remove it here
  roslens agent base.local:7411 --key-file ~/.roslens-key --enrolled ~/arm    it may act, as ~/arm/allow.yaml permits"""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the monitor's address and the key."""
    parser.add_argument("monitor", nargs="?", metavar="HOST[:PORT]", help=f"the monitor (port {DEFAULT_PORT})")
    parser.add_argument("--key-file", type=Path, metavar="FILE", help="the key that monitor and agents share")
    parser.add_argument("--new-key", type=Path, metavar="FILE", help="write a key of 256 random bits and end")
    parser.add_argument("--make-key", dest="new_key", type=Path, metavar="FILE", help=argparse.SUPPRESS)
    parser.add_argument(
        "--enrol",
        type=Path,
        metavar="FOLDER",
        help="write the keys and certificates that let this host act for its monitor",
    )
    parser.add_argument(
        "--enrolled", type=Path, metavar="FOLDER", help="accept requests, as far as allow.yaml in it permits"
    )
    parser.add_argument(
        "--requests",
        metavar="HOST[:PORT]",
        help=f"the host that may send requests (default: the monitor, port {DEFAULT_REQUESTS_PORT})",
    )
    parser.add_argument(
        "--journal", type=Path, metavar="FILE", help="of requests (default: in this user's state folder)"
    )
    parser.add_argument("--name", default=platform.node(), help="what to call this host (default: its host name)")
    parser.add_argument("--period", type=float, default=1.0, metavar="S", help="seconds between samples (default: 1)")


def run(options: argparse.Namespace) -> int:
    """Sample until interrupted or asked to end.

    Raises:
        UsageError: there is no monitor or no key, or the period makes no sense.
    """
    from roslens.live.agent.key_file import read_key, write_key

    if options.new_key is not None:
        write_key(options.new_key)
        print(f"roslens: wrote {options.new_key}; copy it to each host, readable for its user alone", file=sys.stderr)
        return 0
    if options.enrol is not None:
        from roslens.live.agent.enrol import enrol

        place = enrol(options.enrol, options.name)
        print(
            f"roslens: copy {place} to {options.name}, write there in allow.yaml what may be done, and remove it here; "
            f"{options.enrol / 'monitor'} stays: roslens react … --enrolled {options.enrol / 'monitor'}",
            file=sys.stderr,
        )
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


def _work(options: argparse.Namespace, address: tuple[str, int], key: bytes) -> None:
    ended: list[int] = []
    signal.signal(signal.SIGTERM, lambda number, _: ended.append(number))
    with contextlib.ExitStack() as stack:
        seen = _acting(options, address, stack) if options.enrolled is not None else lambda _: None
        _agent(options, address, key, seen).run(lambda: bool(ended))


def _agent(
    options: argparse.Namespace,
    address: tuple[str, int],
    key: bytes,
    seen: Callable[[Mapping[int, Iterable[str]]], None],
) -> Agent:
    import os
    import time

    from roslens.live.agent.gpu import gpu_reader
    from roslens.live.agent.host import HostSampler
    from roslens.live.agent.identity import own_identities
    from roslens.live.agent.processes import ProcessSampler
    from roslens.live.agent.work import Agent
    from roslens.live.inside.host_counters import HostCounters

    return Agent(
        options.name,
        HostSampler(options.name, gpu=gpu_reader()),
        ProcessSampler(options.name),
        address=address,
        key=key,
        wall=time.time,
        steady=time.monotonic,
        period_s=options.period,
        say=_say,
        counters=HostCounters(options.name, os.environ),
        identities=own_identities,
        seen=seen,
    )


def _say(text: str) -> None:
    print(f"roslens agent: {text}", file=sys.stderr, flush=True)


def _acting(
    options: argparse.Namespace, address: tuple[str, int], stack: contextlib.ExitStack
) -> Callable[[Mapping[int, Iterable[str]]], None]:
    """Take requests until the stack ends; return what learns which processes hold nodes."""
    import os
    import time

    from roslens.cli.react.hold_file import Held
    from roslens.cli.workplace.journal_key import journal_signing
    from roslens.intake.user_folder import state_folder
    from roslens.live.agent.acting import Acting
    from roslens.live.agent.enrol import read_agent
    from roslens.store.journals.journal import Journal

    requests = (address[0], DEFAULT_REQUESTS_PORT)
    if options.requests is not None:
        requests = address_of(options.requests, DEFAULT_REQUESTS_PORT)
    state = state_folder(os.environ)
    path = options.journal or state / "agent-journal.jsonl"
    journal = stack.enter_context(Journal(path, journal_signing(path, os.environ)))
    acting = Acting(
        options.name, requests, read_agent(options.enrolled), journal, say=_say, wall=time.time,
        output=state / "nodes", held=Held(os.environ),
    )  # fmt: skip
    stack.callback(acting.close)
    return acting.records.keep
