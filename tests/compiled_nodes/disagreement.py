"""Runs generated nodes, evaluates their source, and tells where the two disagree."""

from __future__ import annotations

import re
import subprocess
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from pathlib import Path

from roslens.model.graph import Role
from roslens.source.extract.facts.node_facts import EndpointFact, NodeFacts, Sure
from roslens.source.extract.interpreter.vocabulary_index import indexed
from roslens.source.extract.lowering.cpp.cpp_program import program_of_cpp
from roslens.source.extract.symbolic.text import Hole, Text
from roslens.source.extract.units.workspace_units import facts_of_workspace
from roslens.source.syntax.macro.macros import load_macros

HEADER = Path(__file__).with_name("recording_rclcpp.hpp")
INCLUDES = "#include <rclcpp/rclcpp.hpp>\n#include <std_msgs/msg/string.hpp>\n"
_ASKED = "bool ask(int);\nint number();\nstd::string text();\nvoid risk();\nvoid left();\n"
_MACROS = load_macros()
_KINDS = {Role.PUBLISHER: "P", Role.SUBSCRIPTION: "S"}


@dataclass
class Run:
    """What one run of a program made: kind, line, name, depth and reliability of each, and how it ended."""

    normal: bool
    left: bool
    made: list[tuple[str, int, str, int, str]] = field(default_factory=list)


def compiled(programs: Sequence[str], where: Path, seeds: int, compiler: str = "g++") -> list[list[Run]]:
    """Return the runs of each program, compiled together.

    Raises:
        subprocess.CalledProcessError: a program does not compile.
    """
    parts = [f'#include "{HEADER}"\n']
    for number, text in enumerate(programs):
        parts.append(f'#line 3 "{number}.cpp"\n{text}')
    calls = "".join(
        f"  for (int seed = 0; seed < {seeds}; ++seed)"
        f" recording::run({number}, seed, [] {{ go<{_space(text)}::Talker>(); }});\n"
        for number, text in enumerate(programs)
    )
    go = "template <typename T> void go() { auto one = std::make_shared<T>(); auto later = recording::later;\n"
    go += "  for (auto & each : later) each(); }\n"
    source = where / "nodes.cpp"
    source.write_text("".join([*parts, go, "int main() {\n", calls, "}\n"]))
    subprocess.run(
        [compiler, "-std=c++17", "-O0", "-w", "-o", str(where / "nodes"), str(source)], check=True, capture_output=True
    )
    out = subprocess.run([str(where / "nodes")], check=True, capture_output=True, text=True).stdout
    found: list[list[Run]] = [[] for _ in programs]
    for line in out.splitlines():
        kind, *rest = line.split("\t")
        if kind == "R":
            found[int(rest[0])].append(Run(rest[2] == "n", rest[3] == "1"))
            here = found[int(rest[0])][-1]
        else:
            here.made.append((kind, int(rest[0]), rest[1], int(rest[2]), rest[3]))
    return found


def _space(text: str) -> str:
    """Return the namespace of a program."""
    return text.split(" ", 2)[1]


def evaluated(text: str) -> NodeFacts:
    """Return what source says of the node of a program."""
    whole = INCLUDES + text
    index = indexed({"pkg/a.cpp": program_of_cpp(whole.encode(), _MACROS)})
    return next(one for one in facts_of_workspace(index) if one.unit.endswith(".Talker") or one.unit == "Talker")


def disagreements(facts: NodeFacts, runs: Iterable[Run]) -> list[str]:
    """Return what facts say otherwise than runs, in words; empty where they agree."""
    runs = list(runs)
    normal = [one for one in runs if one.normal and not one.left]
    untold = {evidence.line for evidence, _ in facts.unresolved}
    seen: dict[tuple[str, int, str], set[tuple[int, str]]] = {}
    for run in runs:
        for kind, line, name, depth, reliability in run.made:
            seen.setdefault((kind, line, name), set()).add((depth, reliability))
    said = _said(facts)
    found = []
    for kind, line, name in sorted(seen):
        here = [one for one in said if one.kind == kind and one.at(line)]
        if line not in untold and not any(one.pattern.fullmatch(name) for one in here):
            found.append(f"missing: {kind} {name!r} at {line}, said: {[str(one.name) for one in here]}")
    for one in said:
        known = one.name.known
        if known is None or not one.certain:
            continue
        times = sum(any(k == one.kind and one.at(line) and n == known for k, line, n, *_ in run.made) for run in normal)
        if not one.conditions and normal and times < len(normal):
            found.append(f"not always: {one.kind} {known!r} at {sorted(one.lines)}, made by {times} of {len(normal)}")
        there = {key for key in seen if key[0] == one.kind and key[1] in one.lines}
        if there and not one.anywhere and not any(key[2] == known for key in there):
            found.append(f"never: {one.kind} {known!r} at {sorted(one.lines)}, made: {sorted(key[2] for key in there)}")
    broken = [f"broken: {reason}" for _, reason in facts.unresolved if "nonsense" in reason]
    return [*broken, *found, *_qualities(said, runs)]


def _qualities(said: list[_Said], runs: list[Run]) -> list[str]:
    """Return endpoints that are made with a quality of service that no fact of them says."""
    found = []
    for kind, line, name, depth, reliability in sorted({made for run in runs for made in run.made if made[0] in "PS"}):
        here = [one for one in said if one.kind == kind and line in one.lines and one.pattern.fullmatch(name)]
        if here and not any(one.has(depth, reliability) for one in here):
            found.append(
                f"quality: {kind} {name!r} at {line} has {depth}{reliability}, said: {[one.quality for one in here]}"
            )
    return found


@dataclass
class _Said:
    kind: str
    lines: frozenset[int]
    name: Text
    certain: bool
    conditions: tuple[str, ...]
    pattern: re.Pattern[str]
    quality: str
    anywhere: bool
    """Whether it is reported at another call than the one that makes it, of which there may be several."""

    def at(self, line: int) -> bool:
        return self.anywhere or line in self.lines

    def has(self, depth: int, reliability: str) -> bool:
        return self.quality in ("", f"{depth}{reliability}")


def _said(facts: NodeFacts) -> list[_Said]:
    found = []
    for one in facts.endpoints:
        kind = _KINDS.get(one.role)
        if kind is not None:
            lines = frozenset((one.evidence.line, *(each.line for each in one.through)))
            certain = one.evidence.sure is Sure.CERTAIN
            quality, anywhere = _quality(one), bool(one.through)
            found.append(_Said(kind, lines, one.name, certain, one.conditions, _pattern(one.name), quality, anywhere))
    for each in facts.parameters:
        if each.access == "declared":
            lines, certain = frozenset((each.evidence.line,)), each.evidence.sure is Sure.CERTAIN
            found.append(_Said("D", lines, each.name, certain, each.conditions, _pattern(each.name), "", True))
    return found


def _quality(one: EndpointFact) -> str:
    if one.qos is None or one.qos_unknown:
        return ""
    return f"{one.qos.depth}{one.qos.reliability[:1]}" if one.qos.reliability and one.qos.depth else ""


def _pattern(name: Text) -> re.Pattern[str]:
    return re.compile(_written(name), re.DOTALL)


def _written(name: Text) -> str:
    return "".join(re.escape(part) if isinstance(part, str) else _any(part) for part in name.parts)


def _any(hole: Hole) -> str:
    if not hole.choice:
        return ".*"
    (one,) = hole.choice
    return f"(?:{_written(one.then)}|{_written(one.otherwise)})"
