"""Graphs that ROSDiscover observed of running robots, and what source and launch files say of the same."""

from __future__ import annotations

from fnmatch import fnmatchcase
from pathlib import Path
from typing import Any

import msgspec
import yaml

from known_mistakes.checkout import check_out
from known_mistakes.pairs import ROOT, read_graph

TABLE = ROOT / "tests" / "fixtures" / "extract" / "rosdiscover" / "golden.yaml"
KINDS = ("node", "publisher", "subscription", "service_server", "action_server")
_OBSERVED = "rosdiscover-evaluation/experiments/recovery/subjects/{}/observed.architecture.yml"
_KEYS = {"pubs": "publisher", "subs": "subscription", "provides": "service_server", "action-servers": "action_server"}
# What observes, and what every node of ROS 1 has.
_WATCHERS = ("/rosout", "/record", "/rostopic", "/rosservice")
_EVERYWHERE = ("*/get_loggers", "*/set_logger_level", "/rosout", "/rosout_agg")

Fact = tuple[str, str, str, str]
"""Kind, node, name and type; a node has only the second."""


class System(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """A robot that was observed.

    Attributes:
        id: of the system in the data set.
        trees: by repository the commit.
        launch: what runs together, inside of ``<launch>``.
        environment: variables of the run.
        machinery: patterns of names that libraries make, which are counted apart: bonds, transports of images.
        seen: by kind how many facts were observed, machinery left out.
        found: by kind how many of them source says.
        said: by kind how many source says, without those under a condition that only a run decides.
        right: by kind how many of those were observed.
        why: of what is missed or too much, in words.
    """

    id: str
    trees: dict[str, str]
    launch: str
    environment: dict[str, str] = {}
    machinery: tuple[str, ...] = ()
    seen: dict[str, int] = {}
    found: dict[str, int] = {}
    said: dict[str, int] = {}
    right: dict[str, int] = {}
    why: tuple[str, ...] = ()


def systems() -> tuple[System, ...]:
    """Return the table."""
    return tuple(msgspec.convert(yaml.safe_load(TABLE.read_text())["systems"], list[System]))


def observed(system: System, clones: Path) -> set[Fact]:
    """Return what was observed."""
    facts: set[Fact] = set()
    for node in yaml.safe_load((clones / _OBSERVED.format(system.id)).read_text()):
        facts.add(("node", node["fullname"], "", ""))
        for key, kind in _KEYS.items():
            facts |= {(kind, node["fullname"], one["name"], one["format"]) for one in node.get(key) or ()}
    return _meant(system, facts)


def read(system: System, clones: Path, folder: Path) -> tuple[set[Fact], set[Fact]]:
    """Return what source says, and of it what it says without a condition."""
    for name, commit in system.trees.items():
        check_out(clones / name, commit, folder / name)
    (folder / "golden.launch").write_text(f"<launch>\n{system.launch}</launch>\n")
    words = "".join(f'{name} = "{value}"\n' for name, value in system.environment.items())
    (folder / "roslens.toml").write_text(f"[workspace.environment]\n{words}")
    graph = read_graph(folder, folder / "golden.launch", "--all")
    inside = {one["name"]: one.get("container") for one in graph["nodes"] if one.get("kind") == "nodelet"}
    every: set[Fact] = set()
    sure: set[Fact] = set()
    for node in graph["nodes"]:
        name = inside.get(node["name"]) or node["name"]
        # A nodelet is part of its manager, and what loads it is a node of its own.
        facts = [(("node", one, "", ""), not node.get("conditions")) for one in (node["name"], name)]
        for one in node.get("endpoints", ()):
            facts += [(fact, not one.get("conditions")) for fact in _facts(name, one)]
        every |= {fact for fact, _plain in facts}
        sure |= {fact for fact, plain in facts if plain and not node.get("conditions")}
    return _meant(system, every), _meant(system, sure)


def _facts(node: str, one: dict[str, Any]) -> list[Fact]:
    """Return an endpoint; a server of an action is its five topics too, as it was observed (wiki.ros.org/actionlib)."""
    end = one["endpoint"]
    role, name, type_ = end["role"], end["name"], end.get("type", "")
    found = [(role, node, name, type_)]
    if role == "action_server":
        found += [("publisher", node, f"{name}/{part.lower()}", f"{type_}{part}") for part in ("Feedback", "Result")]
        found.append(("publisher", node, f"{name}/status", "actionlib_msgs/GoalStatusArray"))
        found.append(("subscription", node, f"{name}/goal", f"{type_}Goal"))
        found.append(("subscription", node, f"{name}/cancel", "actionlib_msgs/GoalID"))
    return found


def _meant(system: System, facts: set[Fact]) -> set[Fact]:
    """Return facts without what watched, what every node has and what libraries make; the types of tf are one."""
    left = set()
    for kind, node, name, type_ in facts:
        if kind not in KINDS or node.startswith(_WATCHERS):
            continue
        if any(fnmatchcase(name, one) for one in (*_EVERYWHERE, *system.machinery)):
            continue
        left.add((kind, node, name, "tf2_msgs/TFMessage" if type_ == "tf/tfMessage" else type_))
    return left


def counts(facts: set[Fact]) -> dict[str, int]:
    """Return how many facts there are of each kind."""
    return {kind: sum(fact[0] == kind for fact in facts) for kind in KINDS}
