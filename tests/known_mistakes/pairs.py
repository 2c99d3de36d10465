"""Pairs of a buggy and a fixed revision, and what `roslens graph --check` tells of both."""

from __future__ import annotations

import json
from contextlib import redirect_stdout
from io import StringIO
from pathlib import Path
from typing import Any

import msgspec
import yaml

from known_mistakes.checkout import check_out

ROOT = Path(__file__).parents[2]
TABLE = ROOT / "tests" / "fixtures" / "extract" / "rosdiscover" / "pairs.yaml"


class Pair(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """A mistake and its correction.

    Attributes:
        id: as in the data set.
        fault: in words.
        peer: whether ROSDiscover finds it.
        trees: by repository the buggy and the fixed commit.
        beside: by repository a commit that is the same on both sides; ``name@part`` where a repository had parts.
        launch: what runs together, inside of ``<launch>``; empty where it is not tried.
        programs: what stands for ``{program}`` in it, buggy and fixed.
        panel: file of a control panel, block and name of the value in it that stands for ``{panel}``: the panel starts
            the launch file with it as an argument.
        reported: rule and entity of the finding; empty where it is not found.
        joined: topic that has both ends in the fixed revision.
        why: it is not found.
    """

    id: str
    fault: str
    peer: bool
    trees: dict[str, tuple[str, str]]
    beside: dict[str, str] = {}
    launch: str = ""
    programs: tuple[str, str] = ("", "")
    panel: tuple[str, ...] = ()
    reported: tuple[str, ...] = ()
    joined: str = ""
    why: str = ""


class Told(msgspec.Struct, frozen=True):
    """What is told of one side: severity by rule and entity, and the names that have both ends."""

    findings: dict[tuple[str, str], str]
    joined: frozenset[str]


def pairs() -> tuple[Pair, ...]:
    """Return the table."""
    return tuple(msgspec.convert(yaml.safe_load(TABLE.read_text())["pairs"], list[Pair]))


def missing(pair: Pair, clones: Path) -> list[str]:
    """Return the repositories of a pair of which there is no clone."""
    names = {name.partition("@")[0] for name in (*pair.trees, *pair.beside)}
    return sorted(name for name in names if not (clones / name).is_dir())


def told(pair: Pair, side: int, clones: Path, folder: Path) -> Told:
    """Lay out one side of a pair in a folder and return what is told of it; 0 is the buggy side."""
    for name, commits in pair.trees.items():
        check_out(clones / name, commits[side], folder / name)
    for name, commit in pair.beside.items():
        check_out(clones / name.partition("@")[0], commit, folder / name.replace("@", "_"))
    launch = folder / "pair.launch"
    text = pair.launch.replace("{program}", pair.programs[side]).replace("{panel}", panel_value(pair, folder))
    launch.write_text(f"<launch>\n{text}</launch>\n")
    checked = _run(folder, launch, "--check", "--fail-on", "never")
    findings = {(one["rule"], one["entity"]): one["severity"] for one in checked}
    graph = read_graph(folder, launch)
    roles: dict[str, set[str]] = {}
    for node in graph["nodes"]:
        for one in node.get("endpoints", ()):
            roles.setdefault(one["endpoint"]["name"], set()).add(one["endpoint"]["role"])
    both = {name for name, found in roles.items() if {"publisher", "subscription"} <= found}
    return Told(findings, frozenset(both))


def panel_value(pair: Pair, folder: Path) -> str:
    """Return the argument that the control panel gives, as its file in a folder says; empty where there is none."""
    if not pair.panel:
        return ""
    file, block, name = pair.panel
    blocks = {one["name"]: one["vars"] for one in yaml.safe_load((folder / file).read_text())["params"]}
    return str(next(one["v"] for one in blocks[block] if one["name"] == name))


def read_graph(folder: Path, launch: Path, *options: str) -> Any:
    """Return the graph of a launch file as JSON."""
    shown = _run(folder, launch, *options)["configurations"]
    (graph,) = [one for one in shown if not one.get("unstarted")]
    return graph


def _run(folder: Path, launch: Path, *options: str) -> Any:
    from roslens.cli.main import main

    out = StringIO()
    with redirect_stdout(out):
        main(["graph", str(folder), "--launch", str(launch), "--format", "json", "-q", "--jobs", "0", *options])
    return json.loads(out.getvalue())
