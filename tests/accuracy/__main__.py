"""Runs systems, records their graphs, reads their source, and writes docs/accuracy.md.

PYTHONPATH=tests .venv/bin/python -m accuracy [--no-run | --page] [SYSTEM...]

What cannot be run here (its parts are named) keeps the graph that was recorded before.
"""

from __future__ import annotations

import argparse
import os
import signal
import sys
import tempfile
from pathlib import Path

from accuracy import ros1, ros2
from accuracy.comparing import compare, silent_nodes
from accuracy.document import document
from accuracy.facts import seen
from accuracy.held_out import held_out
from accuracy.held_out_page import section
from accuracy.kept import keep, kept_facts, kept_graph
from accuracy.observing import NotThereError
from accuracy.reading import lay_out, read
from accuracy.system import ROOT, System, missing, systems

PAGE = ROOT / "docs" / "accuracy.md"


def renew(system: System, *, run: bool, domain: int) -> str:
    """Run and read one system and keep what comes of it; return what could not be done."""
    if reason := missing(system):
        return reason
    live = ros1 if system.generation == "ros1" else ros2
    reason = live.why_not(system) if run else ""
    graph = kept_graph(system)
    with tempfile.TemporaryDirectory() as made:
        folder = Path(made)
        workspace = lay_out(system, folder / "workspace")
        told = read(system, folder / "workspace")
        if run and not reason:
            (folder / "run").mkdir()
            try:
                if system.generation == "ros1":
                    graph = ros1.record(system, workspace, folder / "run")
                else:
                    graph = ros2.record(system, workspace, folder / "run", domain)
            except NotThereError as error:
                reason = str(error)
    keep(system, graph, told)
    return reason


def _say(text: str) -> None:
    sys.stdout.write(f"{text}\n")
    sys.stdout.flush()


def main(words: list[str]) -> int:
    """Run; return the exit code."""
    parser = argparse.ArgumentParser(prog="python -m accuracy", description=__doc__)
    parser.add_argument("system", nargs="*", help="only these; the page is written of all")
    parser.add_argument("--no-run", action="store_true", help="read source only, and keep the graphs that are recorded")
    parser.add_argument("--page", action="store_true", help="write the page only, of what is recorded and judged")
    options = parser.parse_args(words)
    # Whoever ends this ends the nodes with it.
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(1))
    known = systems()
    domain = int(os.environ.get("ROS_DOMAIN_ID", "63"))
    failed = False
    for name in () if options.page else options.system or known:
        reason = renew(known[name], run=not options.no_run, domain=domain)
        failed |= bool(reason)
        _say(f"{name}: {reason or 'renewed'}")
    found = []
    for system in known.values():
        graph = kept_graph(system)
        if graph is None:
            continue
        one = compare(seen(graph), kept_facts(system), system.reasons, system.generation, silent_nodes(graph))
        found.append((system, one))
        for difference in one.unexplained:
            _say(f"{system.name}: unexplained: {difference.what}: {difference.text}")
    PAGE.write_text(document(found, section(held_out())))
    return int(failed)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
