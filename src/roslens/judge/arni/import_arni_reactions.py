"""Converts countermeasures of ARNI to reactions, and reports the outcome of each of their lines.

ARNI keeps them at ``/arni/countermeasure/constraints``: a name to ``constraint`` (a tree of ``and``, ``or`` and ``not``
over ``<id>: {<field>: high|low|ok|unknown|out_of_bounds}``), ``min_reaction_interval`` (so long it has to hold, 10 s by
default), ``reaction_timeout`` (so long it is not done again, 30 s by default) and ``reactions`` (publish, stop,
restart, run). What stood above ``config: reaction_autonomy_level`` was never done.
"""

from __future__ import annotations

import json
import re
from collections.abc import Callable, Iterator
from typing import Any

import msgspec

from roslens.judge.arni.arni_fields import FIELDS, field_of
from roslens.judge.arni.arni_ids import read_id
from roslens.judge.arni.arni_limits import number_of
from roslens.judge.documents.document import described
from roslens.judge.documents.yaml_tree import Items, Node, Place, Scalar, Table
from roslens.judge.ranges.amount import amount_text
from roslens.model.entity import EntityKind
from roslens.plugins.nearest import did_you_mean

_TREES = {"and": "all", "or": "any", "not": "not"}
_STATES: dict[str, str | list[str]] = {
    "high": "high", "low": "low", "ok": "ok", "unknown": "unknown", "out_of_bounds": ["low", "high"],
}  # fmt: skip
_LEVELS = {
    "debug": "info", "info": "info", "warn": "warning", "warning": "warning", "error": "error", "err": "error",
    "fatal": "error",
}  # fmt: skip
_OF_HOSTS = {"cpu_usage": "node_cpu_usage", "ram_usage": "node_ramusage"}
_HOLDS_S, _PAUSE_S = 10.0, 30.0
_CONSTRAINT_KEYS = ("constraint", "reactions", "min_reaction_interval", "reaction_timeout")
_DEEPEST = 10

IMPORTED, CHANGED, LEFT_OUT = "imported", "changed", "left out"

Tell = Callable[[Place, str, str, str], None]
"""Takes the place of a line, what became of it, what it is, and why."""


class _LeftOutError(Exception):
    """A condition that cannot be expressed; its outcome was reported already."""


def has_countermeasures(root: Node | None) -> bool:
    """Whether a file has any."""
    return _table(root, "countermeasure") is not None


def reactions_of(root: Node | None, tell: Tell) -> list[str]:
    """Return the lines of the reactions of a file, and report the outcome of each of its lines."""
    found = _table(root, "countermeasure")
    constraints = found.nodes.get("constraints") if found is not None else None
    if found is None:
        return []
    if not isinstance(constraints, Table) or not constraints.nodes:
        tell(found.place, LEFT_OUT, "countermeasure", "it has no `constraints:` with names below it")
        return []
    level = _level(found, tell)
    for key, place in found.keys.items():
        if key not in ("constraints", "config"):
            tell(place, LEFT_OUT, key, "it is not part of the countermeasures")
    lines: list[str] = []
    taken: set[str] = set()
    for name, node in constraints.nodes.items():
        lines += _Reaction(name, constraints.keys[name], tell, level, taken).lines(node)
    return lines


def _table(root: Node | None, key: str) -> Table | None:
    node = root
    for one in ("arni", key):
        if isinstance(node, Table):
            inner = next((name for name in (one, f"/{one}", f"{one}/", f"/arni/{key}") if name in node.nodes), "")
            node = node.nodes[inner] if inner else node
    found = isinstance(root, Table) and node is not root and isinstance(node, Table)
    return (
        node if found and isinstance(node, Table) and ("constraints" in node.nodes or "config" in node.nodes) else None
    )


def _level(found: Table, tell: Tell) -> float:
    """Return above which autonomy nothing was ever done."""
    config = found.nodes.get("config")
    if not isinstance(config, Table):
        return float("inf")
    for key, place in config.keys.items():
        if key != "reaction_autonomy_level":
            tell(
                place, LEFT_OUT, f"config {key}", "roslens decides with every look, and knows how old what it holds is"
            )
    level = number_of(config.nodes["reaction_autonomy_level"]) if "reaction_autonomy_level" in config.nodes else None
    return float("inf") if level is None else float(level)


class _Reaction:
    """One constraint of ARNI, which becomes a reaction."""

    def __init__(self, name: str, place: Place, tell: Tell, level: float, taken: set[str]) -> None:
        self._name = name
        self._place = place
        self._say = tell
        self._level = level
        slug = re.sub(r"[^a-z0-9_-]+", "-", name.lower()).strip("-")[:60] or "reaction"
        number = 1
        while (found := slug if number == 1 else f"{slug}-{number}") in taken:
            number += 1
        taken.add(found)
        self._id = found

    def lines(self, node: Node) -> list[str]:
        """Return the lines of the reaction; none where nothing is left of it."""
        if not isinstance(node, Table) or "constraint" not in node.nodes:
            self._tell(self._place, LEFT_OUT, "", f"it is {described(node)}, expected `constraint:` and `reactions:`")
            return []
        for key, place in node.keys.items():
            if key not in _CONSTRAINT_KEYS:
                self._tell(place, LEFT_OUT, key, "ARNI has no such key")
        try:
            parts = self._conditions(self._root(node.nodes["constraint"], node.keys["constraint"]), 0)
        except _LeftOutError:
            self._tell(self._place, LEFT_OUT, "", "its condition cannot be said, so nothing of it is done")
            return []
        steps = self._steps(node)
        if not parts or not steps:
            self._tell(self._place, LEFT_OUT, "", "nothing is left of it")
            return []
        when = parts[0] if len(parts) == 1 else {"all": parts}
        when = {**when, "for": self._seconds(node, "min_reaction_interval", _HOLDS_S)}
        pause = self._seconds(node, "reaction_timeout", _PAUSE_S)
        why = f"`{self._id}`; only first causes count now, `effects: true` takes all"
        self._tell(self._place, CHANGED, "", f"{why}; what ARNI did at once is done in this order")
        return [
            f"  - id: {json.dumps(self._id)}", f"    when: {_flow(when)}", f"    cool_down: {pause}", "    do:",
            *(f"      - {_flow(step)}" for step in steps),
        ]  # fmt: skip

    def _root(self, node: Node, place: Place) -> Table:
        if isinstance(node, Items) and len(node.nodes) == 1:
            node = node.nodes[0]
        if not isinstance(node, Table) or not node.nodes:
            self._tell(place, LEFT_OUT, "constraint", f"it is {described(node)}, expected one condition")
            raise _LeftOutError
        return node

    def _conditions(self, table: Table, depth: int) -> list[dict[str, Any]]:
        """Return what stands beside each other in a table of ARNI's."""
        found: list[dict[str, Any]] = []
        for key, node in table.nodes.items():
            place = table.keys[key]
            if not isinstance(node, Table) or depth > _DEEPEST:
                self._tell(place, LEFT_OUT, key, f"it is {described(node)}, expected conditions")
                raise _LeftOutError
            if key not in _TREES:
                found += self._leaves(key, node, place)
                continue
            inner = self._conditions(node, depth + 1)
            if key == "not":
                why = "`not`: unknown values made it true in ARNI, but no longer do"
                self._tell(place, CHANGED, key, why)
                found += [{"not": one} for one in inner]
            else:
                found.append(inner[0] if len(inner) == 1 else {_TREES[key]: inner})
        if not found:
            self._tell(table.place, LEFT_OUT, "constraint", "it is empty")
            raise _LeftOutError
        return found

    def _leaves(self, seuid: str, fields: Table, place: Place) -> Iterator[dict[str, Any]]:
        selected = read_id(seuid)
        if isinstance(selected, str):
            self._tell(place, LEFT_OUT, seuid, selected)
            raise _LeftOutError
        for field, node in fields.nodes.items():
            at, what = fields.keys[field], f"{seuid} {field}"
            known, note = self._known(selected.kind, field)
            meaning = field_of(selected.kind, known)
            state = node.text.strip().lower() if isinstance(node, Scalar) else ""
            if meaning is None or not meaning.signal:
                advice = did_you_mean(field, FIELDS[selected.kind])
                why = (
                    meaning.note if meaning else f"ARNI has no such field of a {selected.kind.value}. {advice}".strip()
                )
                self._tell(at, LEFT_OUT, what, why)
                raise _LeftOutError
            if state not in _STATES:
                self._tell(at, LEFT_OUT, what, f"it is {described(node)}, expected one of {', '.join(_STATES)}")
                raise _LeftOutError
            notes = [one for one in (note, meaning.note, selected.odd) if one]
            self._tell(at, CHANGED if notes else IMPORTED, what, "; ".join([f"`{meaning.signal}` is {state}", *notes]))
            yield {**dict(selected.lines), "signal": meaning.signal, "is": _STATES[state]}

    @staticmethod
    def _known(kind: EntityKind, field: str) -> tuple[str, str]:
        """Return a field as ARNI has it of a kind; its own files have fields of hosts with nodes."""
        if kind is EntityKind.NODE and field_of(kind, field) is None:
            for of_host, of_node in _OF_HOSTS.items():
                if field.startswith(of_host) and field_of(kind, other := field.replace(of_host, of_node)) is not None:
                    return other, f"ARNI has no such field of a node, and was never true; taken for {other}"
        return field, ""

    def _steps(self, node: Table) -> list[dict[str, Any]]:
        reactions = node.nodes.get("reactions")
        if not isinstance(reactions, Table):
            self._tell(node.keys.get("reactions", node.place), LEFT_OUT, "reactions", "there are none")
            return []
        found = []
        for name, one in reactions.nodes.items():
            if (step := self._step(name, one, reactions.keys[name])) is not None:
                found.append(step)
        return found

    def _step(self, name: str, node: Node, place: Place) -> dict[str, Any] | None:
        if not isinstance(node, Table):
            self._tell(place, LEFT_OUT, name, f"it is {described(node)}, expected `action:`")
            return None
        reported = {key: one.text.strip() for key, one in node.nodes.items() if isinstance(one, Scalar)}
        level = number_of(node.nodes["autonomy_level"]) if "autonomy_level" in node.nodes else None
        if level is not None and float(level) > self._level:
            why = f"its autonomy level {float(level):g} is above {self._level:g}, so that ARNI never did it"
            self._tell(place, LEFT_OUT, name, why)
            return None
        action = reported.get("action", "")
        if action == "publish":
            return self._notice(name, reported, place)
        if action not in ("stop", "restart", "run"):
            why = f"ARNI has no action {action[:60]!r}" if action else "it has no action"
            self._tell(place, LEFT_OUT, name, why)
            return None
        target = reported.get("node", "")
        if not target or not target.isprintable() or "{" in target:
            self._tell(place, LEFT_OUT, name, "it names no node")
            return None
        target = target if target.startswith("/") else f"/{target}"
        if action == "run":
            return self._command(name, target, reported.get("command", ""), place)
        self._tell(place, CHANGED, name, f"`{action}` of {target}: the host has to have it on its allow-list")
        return {action: {"node": target}}

    def _notice(self, name: str, reported: dict[str, str], place: Place) -> dict[str, Any]:
        level = _LEVELS.get(reported.get("loglevel", "").removeprefix("log").lower())
        why = "" if level else "without a level that there is, ARNI ended when it read this; taken for info"
        self._tell(place, CHANGED if why else IMPORTED, name, "; ".join(filter(None, ["`notify`", why])))
        text = reported.get("message", "").replace("{", "{{").replace("}", "}}") or self._name
        return {"notify": {"text": text, "level": level or "info"}}

    def _command(self, name: str, target: str, command: str, place: Place) -> dict[str, Any]:
        called = re.sub(r"[^A-Za-z0-9_-]+", "_", f"{self._id}_{name}")[:60]
        words = json.dumps(["/bin/sh", "-c", command], ensure_ascii=False)
        why = (
            f"no text of a document reaches a shell: the host of {target} has to have it on its allow-list, as "
            f"`- {{name: {called}, run: {words}}}` or better without a shell"
        )
        self._tell(place, CHANGED, name, why)
        return {"command": {"node": target, "name": called}}

    def _seconds(self, node: Table, key: str, usual: float) -> str:
        if key not in node.nodes:
            return amount_text(usual, "s")
        found = number_of(node.nodes[key])
        if found is None or not 0 <= float(found) < 10**9:
            what = described(node.nodes[key])
            self._tell(
                node.keys[key], CHANGED, key, f"it is {what}, expected seconds; taken for {usual:g} s as in ARNI"
            )
            return amount_text(usual, "s")
        self._tell(node.keys[key], IMPORTED, key, "`for`" if key == "min_reaction_interval" else "`cool_down`")
        return amount_text(float(found), "s")

    def _tell(self, place: Place, outcome: str, what: str, why: str) -> None:
        self._say(place, outcome, f"{self._name} {what}".strip(), why)


def _flow(value: Any) -> str:
    """Return a value as YAML on one line, which JSON is."""
    return msgspec.json.encode(value).decode()
