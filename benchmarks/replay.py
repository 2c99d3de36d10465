"""What it costs to rate a recording: a million messages on 20 topics against 50 sentences.

    python benchmarks/replay.py [--messages 1000000] [--rounds 3]

Beside it the rosbags library going through all messages without decoding them. CPU seconds of whole processes.
"""

from __future__ import annotations

import argparse
import multiprocessing
import sys
import tempfile
from pathlib import Path

from bags import LIBRARY, written
from measure import in_turn, middle, ratio

REFERENCE = """kind: reference
name: bench
constraints:
{sentences}"""


def sentences(topics: list[str]) -> str:
    """Return 50 sentences, of patterns and of single topics."""
    lines = ['  - {topic: "/**", rate: 100..100000 Hz}', '  - {topic: "/**", largest_gap: <= 1 s, severity: error}']
    keys = ("rate: 500..2000 Hz", "largest_gap: <= 100 ms", "jitter: <= 50 ms")
    lines += [f"  - {{topic: {topic}, {key}}}" for topic in topics for key in keys]
    return "\n".join(lines[:50]) + "\n"


def main() -> int:
    """Measure and print a table."""
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("--messages", type=int, default=1_000_000)
    arguments.add_argument("--rounds", type=int, default=3)
    options = arguments.parse_args()
    with tempfile.TemporaryDirectory(prefix="roslens-bench-") as scratch:
        # In a process of its own: what this one holds would count as the peak of those it starts.
        with multiprocessing.get_context("spawn").Pool(1) as writer:
            paths = writer.apply(written, (Path(scratch), options.messages))
        mcap = next(path for name, path in paths.items() if name == "MCAP")
        from roslens.live.adapters.bag.open_bag import open_bag

        reference = Path(scratch, "bench.yaml")
        reference.write_text(REFERENCE.format(sentences=sentences([topic.name for topic in open_bag(mcap).topics])))
        program = str(Path(sys.executable).with_name("roslens"))
        commands = {
            "rosbags, messages only": [sys.executable, "-c", LIBRARY, str(mcap), "", str(options.messages)],
            "roslens watch --bag": [
                program, "watch", "--bag", str(mcap), "--reference", str(reference), "-q", "--fail-on", "never",
            ],
        }  # fmt: skip
        costs = in_turn(commands, options.rounds, {})
    print(f"{options.messages:,} messages, 50 sentences; medians of {options.rounds} rounds\n")
    print("| run | CPU s | peak MB | by rosbags |\n| --- | --- | --- | --- |")
    for name, found in costs.items():
        share = ratio(costs, name, "rosbags, messages only")
        peak = middle([one.peak_mb for one in found])
        print(f"| {name} | {middle([one.cpu_s for one in found]):.2f} | {peak:.0f} | {share:.2f} |")
    return 0


if __name__ == "__main__":
    sys.exit(main())
