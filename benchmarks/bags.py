"""The figures of docs/costs.md on reading recordings.

    python benchmarks/bags.py [--messages 1000000] [--rounds 3]

Writes recordings of PoseStamped on 20 topics to a temporary folder, then lets processes read them in turn: the
tallies of all topics from the index, the same with the age of every message, and the rosbags library going through
all messages without decoding them. Rates are messages by CPU seconds from before the file is opened to the last
tally, in a process that has imported what it needs; peak memory is that of the process. Machines are shared, so the
least of several rounds is reported: what others take of the caches is in the longer ones. The ratio to rosbags is the
median of those of the rounds.
"""

from __future__ import annotations

import argparse
import multiprocessing
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

from measure import middle

TOPICS = 20
STEP_NS = 50_000

INDEX = """
import resource, sys, time
from pathlib import Path
import rosbags.highlevel
from rosbags.typesys import Stores, get_typestore
from roslens.live.adapters.bag.open_bag import open_bag
get_typestore(Stores.LATEST)
begun = time.process_time()
bag = open_bag(Path(sys.argv[1]))
stamps = {topic.name for topic in bag.topics} if sys.argv[2] == "ages" else ()
counted = sum(tally.count for _, tallies in bag.tallies(1.0, stamps) for tally in tallies)
print(time.process_time() - begun, resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024)
sys.exit(0 if counted == int(sys.argv[3]) and not bag.failures else 4)
"""

LIBRARY = """
import resource, sys, time
from pathlib import Path
import roslens.live.adapters.bag.open_bag
from rosbags.highlevel import AnyReader
begun = time.process_time()
with AnyReader([Path(sys.argv[1])]) as reader:
    counted = sum(1 for _ in reader.messages())
print(time.process_time() - begun, resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024)
sys.exit(0 if counted == int(sys.argv[3]) else 4)
"""


def written(folder: Path, messages: int) -> dict[str, Path]:
    """Write one recording of each kind."""
    from rosbags.rosbag1 import Writer as Writer1
    from rosbags.rosbag2 import CompressionFormat, CompressionMode, StoragePlugin, Writer
    from rosbags.typesys import Stores, get_typestore

    store1, store2 = get_typestore(Stores.ROS1_NOETIC), get_typestore(Stores.LATEST)
    kind = "geometry_msgs/msg/PoseStamped"
    start = 1_700_000_000_000_000_000
    content = (
        b"\x00\x01\x00\x00" + (start // 10**9).to_bytes(4, "little") + bytes(4) + b"\x04\x00\x00\x00map\x00" + bytes(56)
    )
    paths = {"ROS 1": folder / "ros1.bag"}
    with Writer1(paths["ROS 1"]) as bag:
        lines = [bag.add_connection(f"/topic_{index}", kind, typestore=store1) for index in range(TOPICS)]
        for number in range(messages):
            bag.write(lines[number % TOPICS], start + number * STEP_NS, content)
    for name, plugin, packed in (
        ("MCAP", StoragePlugin.MCAP, False),
        ("MCAP, zstd", StoragePlugin.MCAP, True),
        ("SQLite", StoragePlugin.SQLITE3, False),
    ):
        paths[name] = folder / name.replace(", ", "_")
        writer = Writer(paths[name], version=9, storage_plugin=plugin)
        if packed:
            writer.set_compression(CompressionMode.STORAGE, CompressionFormat.ZSTD)
        with writer as bag2:
            lines = [bag2.add_connection(f"/topic_{index}", kind, typestore=store2) for index in range(TOPICS)]
            for number in range(messages):
                bag2.write(lines[number % TOPICS], start + number * STEP_NS, content)
    return paths


def measured(script: str, path: Path, way: str, messages: int) -> tuple[float, float]:
    """Return CPU seconds and peak memory in MB of one reading."""
    command = [sys.executable, "-c", script, str(path), way, str(messages)]
    cpu, peak = subprocess.run(command, capture_output=True, check=True, text=True).stdout.split()
    return float(cpu), float(peak)


def main() -> int:
    """Measure and print a table."""
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("--messages", type=int, default=1_000_000)
    arguments.add_argument("--rounds", type=int, default=5)
    arguments.add_argument("--without-library", action="store_true", help="leave the slow peer out")
    options = arguments.parse_args()
    scratch = Path(tempfile.mkdtemp(prefix="roslens-bench-"))
    scripts = {"rosbags": LIBRARY} if not options.without_library else {}
    scripts |= {"index": INDEX, "ages": INDEX}
    costs: dict[tuple[str, str], list[tuple[float, float]]] = {}
    try:
        # In a process of its own: what this one holds would count as the peak of those it starts.
        with multiprocessing.get_context("spawn").Pool(1) as writer:
            paths = writer.apply(written, (scratch, options.messages))
        for _ in range(options.rounds):
            for name, path in paths.items():
                for way, script in scripts.items():
                    costs.setdefault((name, way), []).append(measured(script, path, way, options.messages))
    finally:
        shutil.rmtree(scratch)
    print(f"{options.messages:,} messages, {TOPICS} topics; {options.rounds} rounds\n")
    print("| recording | read | CPU s | million/s | peak MB | times rosbags |")
    print("| --- | --- | --- | --- | --- | --- |")
    for (name, way), runs in costs.items():
        cpu, peak = min(cost for cost, _ in runs), middle([peak for _, peak in runs])
        peers = costs.get((name, "rosbags"), [])
        ratios = [peer / cost for (peer, _), (cost, _) in zip(peers, runs, strict=bool(peers))]
        factor = f"{middle(ratios):.1f}" if ratios else ""
        print(f"| {name} | {way} | {cpu:.3f} | {options.messages / cpu / 1e6:.2f} | {peak:.0f} | {factor} |")
    return 0


if __name__ == "__main__":
    sys.exit(main())
