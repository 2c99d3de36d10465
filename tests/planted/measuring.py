"""Plants twenty variants of each rule's example and asks the command line for them."""

from __future__ import annotations

import json
import re
import subprocess
import sys
from collections import defaultdict
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from random import Random
from tempfile import TemporaryDirectory
from typing import Any

import msgspec

from planted.hosts import hosts
from planted.packages import broken_packages, package_variant
from planted.planting import Planted, plant_cpp, plant_python, without_guard
from planted.variants import VARIANTS, variant
from roslens.source.rules.rule import FileRule, Rule
from roslens.source.rules.table import native_rules

ROOT = Path(__file__).parents[2]
FIXTURES = ROOT / "tests" / "fixtures" / "rules"
_MANIFEST = (
    '<package format="3"><name>{}</name><version>1.0.0</version><description>Drives a robot.</description>'
    '<maintainer email="a@robots.dev">a</maintainer><license>MIT</license>{}'
    "<export><build_type>{}</build_type></export></package>\n"
)
_DEPENDS = {
    "ros2": "<depend>rclcpp</depend><exec_depend>rclpy</exec_depend>",
    "ros1": "<depend>roscpp</depend><exec_depend>rospy</exec_depend>",
}
_BUILD = {"ros2": "ament_cmake", "ros1": "catkin"}


_WAITS = r"[sS]pin|while|[sS]leep|[wW]ait|[rR]un|[lL]oop|join|exec|start|input|show|serve|listen|launch|interact|pause"
SILENT = {
    **dict.fromkeys(("node.spin_missing", "node.spin_missing_python"), (_WAITS, "the file spins or waits")),
    "node.unlocked_state": (r"mutex|atomic|lock|[rR]ealtime|SingleThreaded|spin", "the file has a lock, or one thread"),
    "node.node_before_init": (r"PLUGINLIB|_PLUGIN\b", "the file holds a plug-in, which a running node loads"),
    "node.rate_without_thread": (r"[tT]hread|spin|asyncio", "the file spins elsewhere"),
    "node.console_output": (r"main\b|argc|printf", "the file is a tool for the command line"),
    "python.python2_name": (r"xrange|six|__future__|version_info", "the file is written for Python 3 too"),
    "node.print_in_node": (r"argparse|optparse|argv|input|print", "the file talks to somebody on the console"),
    "python.work_on_import": (r"init_node|rclpy\.init|\.spin\(", "the file does it already, and it is said once"),
}
"""Rules that a whole file silences on purpose: what real files must not have, and what it tells."""


class Count(msgspec.Struct, frozen=True):
    """How many places that break a rule were planted and found, and where the others are.

    Attributes:
        planted: places.
        found: of them.
        missed: variants, by number.
    """

    planted: int
    found: int
    missed: tuple[int, ...] = ()


class Place(msgspec.Struct, frozen=True):
    """Where a variant was planted: lines of a file, those of its includes too, or a package."""

    rule: str
    number: int
    path: str
    first: int = 0
    last: int = 0
    head: int = 0
    count: int = 1


def default_rules() -> list[Rule]:
    """Return the rules that are on for a package of ROS without any setting."""
    return [rule for rule in native_rules().values() if {"ros1", "ros2"} & set(rule.profiles)]


def measure(
    rules: Sequence[Rule], folders: Sequence[Path], seed: int, numbers: Iterable[int] = range(VARIANTS)
) -> dict[str, Count]:
    """Return, by rule, how many of the planted variants ``roslens check`` finds.

    Args:
        rules: to be broken.
        folders: with the real files to plant into.
        seed: of the choice of files and places.
        numbers: of the variants.
    """
    with TemporaryDirectory() as scratch:
        root = Path(scratch, "ws")
        places = plant(rules, folders, seed, tuple(numbers), root)
        return compare(places, findings(root))


def plant(rules: Sequence[Rule], folders: Sequence[Path], seed: int, numbers: Sequence[int], root: Path) -> list[Place]:
    """Write a workspace of packages with one variant of each rule in each, and return where they are."""
    real = {kind: hosts(folders, kind, seed) for kind in ("cpp", "header", "python")}
    places: list[Place] = []
    for rule in rules:
        version = "ros2" if "ros2" in rule.profiles else "ros1"
        for number in numbers:
            random = Random(f"{seed} {rule.id} {number}")
            if isinstance(rule, FileRule):
                package = root / f"{version}_{number}"
                made = _plant_file(rule, number, real, random)
                if made is None:
                    raise ValueError(f"no real file serves for variant {number} of {rule.id}: name more folders")
                planted, ending = made
                path = package / "src" / f"{rule.id.replace('.', '_')}_{number}{ending}"
                _write(path, planted.content.encode())
                places.append(
                    Place(rule.id, number, path.relative_to(root).as_posix(), planted.first, planted.last, planted.head)
                )
            else:
                places += _plant_package(rule, number, real["cpp"][:40], random, root)
    for package in {root / place.path.split("/")[0] for place in places if place.first}:
        version = package.name.partition("_")[0]
        manifest = _MANIFEST.format(package.name, _DEPENDS[version], _BUILD[version])
        _write(package / "package.xml", manifest.encode())
    return places


def _plant_file(
    rule: FileRule, number: int, real: Mapping[str, list[Path]], random: Random
) -> tuple[Planted, str] | None:
    kind = "python" if rule.syntax == "python" else "header" if "header" in rule.tags else "cpp"
    text = variant(rule.bad, rule.syntax, number, rule.id)
    has_main = "main(" in text or "__main__" in text
    ones = real[kind]
    start = random.randrange(len(ones)) if ones else 0
    for host in (*ones[start:], *ones[:start]):
        content = host.read_text("ascii")
        if has_main and ("main(" in content or "spin" in content or "__main__" in content):
            continue
        if rule.id in SILENT and re.search(SILENT[rule.id][0], content):
            continue
        if rule.id == "cpp.guard":
            made = without_guard(content)
        elif rule.syntax == "python":
            made = plant_python(content, text, random)
        else:
            made = plant_cpp(content, text, random)
        if made is not None:
            return made, {"python": ".py", "header": ".hpp", "cpp": ".cpp"}[kind]
    return None


def _plant_package(rule: Rule, number: int, spare: Sequence[Path], random: Random, root: Path) -> list[Place]:
    family, name = rule.id.split(".")
    folders = broken_packages(FIXTURES / family / name) or [
        one for below in (FIXTURES / family).rglob(name) for one in broken_packages(below)
    ]
    package, count = folders[number % len(folders)]
    path = root / f"{name}_{number}"
    deep = path / "src" / "group" if number % 3 == 2 else path
    for inside, content in package_variant(package, number, spare, random).items():
        _write(deep / inside, content)
    return [Place(rule.id, number, path.relative_to(root).as_posix(), count=count)]


def _write(path: Path, content: bytes) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(content)


def findings(root: Path) -> list[dict[str, Any]]:
    """Return what the command line finds in a workspace, without any setting."""
    program = str(Path(sys.executable).with_name("roslens"))
    out = root.parent / "run.json"
    command = [program, "check", str(root), "--no-graph", "--no-store", "--no-cache", "-q", "--fail-on", "never"]
    ended = subprocess.run(
        [*command, "--format", "json", "-o", str(out)], capture_output=True, text=True, check=False, timeout=1800
    )
    if ended.returncode not in (0, 3):
        raise RuntimeError(f"roslens check ended with {ended.returncode}: {ended.stderr[-500:]}")
    found: list[dict[str, Any]] = json.loads(out.read_text("utf-8"))["findings"]
    return found


def _is_in(place: Place, path: str, line: int) -> bool:
    if not place.first:
        return path.startswith(f"{place.path}/")
    return path == place.path and (place.first <= line <= place.last or 1 <= line <= place.head)


def compare(places: Sequence[Place], found: Iterable[Mapping[str, Any]]) -> dict[str, Count]:
    """Return, by rule, how many of the planted places a finding of the rule is in."""
    by_rule: dict[str, list[tuple[str, int]]] = defaultdict(list)
    for one in found:
        by_rule[one["rule"]].append((one.get("path", ""), one.get("line", 0)))
    counts: dict[str, list[Any]] = defaultdict(lambda: [0, 0, []])
    for place in places:
        hits = sum(_is_in(place, path, line) for path, line in by_rule[place.rule])
        count = counts[place.rule]
        count[0] += place.count
        count[1] += min(place.count, hits)
        if hits < place.count:
            count[2].append(place.number)
    return {rule: Count(planted, seen, tuple(missed)) for rule, (planted, seen, missed) in sorted(counts.items())}
