"""What the preloaded library costs a message: with a middleware that does nothing, and in real nodes where ROS 2 is.

    python benchmarks/preload.py [--ros2 PYTHON]

The first figures are the CPU time that the library adds to a call, and its share of the 0.3 us that it may add. The
others are the CPU time of talker and listener per message, in turns without the library and with it.
"""

from __future__ import annotations

import argparse
import importlib.util
import json
import os
import subprocess
import sys
import tempfile
from pathlib import Path
from statistics import median
from typing import Any

ROOT = Path(__file__).parents[1]
NATIVE = ROOT / "native"
PAIR = ROOT / "tests" / "native" / "ros2_pair.py"
MESSAGES = 2_000_000
ROUNDS = 7
ALLOWED_NS = 300.0
REAL_MESSAGES = 3_000
REAL_ROUNDS = 8


def main() -> int:
    """Measure and print."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--ros2", default=os.environ.get("ROSLENS_ROS2_PYTHON", ROOT / "build/ros2/bin/python"))
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        library, program = _built(Path(folder))
        without = _cost(program, {})
        for publishers in (1, 50):
            loaded = _cost(program, {"LD_PRELOAD": str(library), "ROSLENS_COUNTERS": folder}, publishers)
            for way, bare, counted in zip(("publish", "take"), without, loaded, strict=True):
                added = counted - bare
                print(
                    f"{way:8} {publishers:3} publishers: {bare:6.1f} ns without, {counted:6.1f} ns with,"
                    f" {added:6.1f} ns added = {added / ALLOWED_NS:.2f} of the allowed {ALLOWED_NS:.0f}"
                )
        if Path(options.ros2).exists():
            _real(str(options.ros2), library, folder)
        else:
            print(f"no {options.ros2}: real nodes are not measured")
    return 0


def _built(folder: Path) -> tuple[Path, Path]:
    specification = importlib.util.spec_from_file_location("hatch_build", ROOT / "hatch_build.py")
    if specification is None or specification.loader is None:
        raise SystemExit("no hatch_build.py")
    build: Any = importlib.util.module_from_spec(specification)
    specification.loader.exec_module(build)
    library = folder / build.LIBRARY
    problem = build.build_library(ROOT, library)
    if problem:
        raise SystemExit(problem)
    compiler = [*build.compiler(), *build.FLAGS]
    tests = NATIVE / "tests"
    fake, program = folder / "librmw_fake.so", folder / "cost"
    subprocess.run([*compiler, "-shared", "-o", fake, tests / "fake_rmw.c"], check=True)
    subprocess.run(
        [*compiler, "-o", program, tests / "cost.c", f"-L{folder}", "-lrmw_fake", "-Wl,-rpath,$ORIGIN"], check=True
    )
    return library, program


def _cost(program: Path, environment: dict[str, str], publishers: int = 1) -> tuple[float, float]:
    """Return ns of CPU to publish and to take a message, the least of several rounds."""
    rounds = [
        subprocess.run(
            [program, str(MESSAGES), str(publishers)], env=environment, capture_output=True, text=True, check=True
        ).stdout.split()
        for _ in range(ROUNDS)
    ]
    return min(float(publish) for publish, _ in rounds), min(float(take) for _, take in rounds)


def _real(python: str, library: Path, folder: str) -> None:
    used: dict[tuple[str, bool], list[float]] = {}
    for number in range(2 * REAL_ROUNDS):
        preloaded = bool(number % 2)
        extra = {"LD_PRELOAD": str(library), "ROSLENS_COUNTERS": folder} if preloaded else {}
        for role, reported in _pair(python, extra).items():
            messages = reported["typed"] + reported["raw"]
            used.setdefault((role, preloaded), []).append(reported["cpu"] / max(1, messages) * 1e6)
    for role in ("talker", "listener"):
        bare, counted = used[role, False], used[role, True]
        print(
            f"{role:8} {min(bare):5.0f} to {max(bare):5.0f} us without,"
            f" {min(counted):5.0f} to {max(counted):5.0f} us with;"
            f" medians {median(bare):5.0f} and {median(counted):5.0f}, ratio {median(counted) / median(bare):.3f}"
        )


def _pair(python: str, extra: dict[str, str]) -> dict[str, dict[str, Any]]:
    environment = {
        "PATH": os.environ["PATH"],
        "HOME": os.environ.get("HOME", "/"),
        "ROS_DOMAIN_ID": str(60 + os.getpid() % 40),
        "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST",
        **extra,
    }
    nodes = {
        role: subprocess.Popen(
            [python, PAIR, role, str(REAL_MESSAGES), "0"],
            env=environment, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True,
        )
        for role in ("listener", "talker")
    }  # fmt: skip
    reported = {role: json.loads(node.stdout.readline() if node.stdout else "") for role, node in nodes.items()}
    for node in nodes.values():
        node.communicate("")
    return reported


if __name__ == "__main__":
    sys.exit(main())
