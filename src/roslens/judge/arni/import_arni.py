"""Converts a file of ARNI to a reference, and reports the outcome of each of its lines.

ARNI keeps lists of ``<id>: {<field>: <limits>}`` at ``/arni/specifications``, one list or one under each of several
names. Ids are ``h!host``, ``n!node``, ``t!topic`` and ``c!subscriber!topic!publisher``. Limits are ``[low, high]`` in
any order, or ``[centre, part, relative]``, or a list of such. Its countermeasures become reactions
(``import_arni_reactions.py``).
"""

from __future__ import annotations

import json
import re
from collections.abc import Iterator, Mapping
from enum import Enum
from pathlib import Path

import msgspec

from roslens.intake.bounded_file import read_bounded
from roslens.judge.arni.arni_clashes import GREATEST, clashes_of
from roslens.judge.arni.arni_fields import FIELDS, ArniField, field_of
from roslens.judge.arni.arni_ids import Selected, read_id
from roslens.judge.arni.arni_limits import number_of, read_limits
from roslens.judge.arni.import_arni_reactions import has_countermeasures, reactions_of
from roslens.judge.documents.document import described
from roslens.judge.documents.yaml_tree import Items, Node, Place, Table, Tree, read_tree
from roslens.judge.ranges.amount import Limits, amount_text, limits_text
from roslens.model.entity import EntityKind
from roslens.model.errors import DocumentError
from roslens.model.quantity import Quantity
from roslens.plugins.nearest import did_you_mean

ALIVE = "alive_timer"
_PLAIN = re.compile(r"[A-Za-z0-9/_<][^:#{}\[\],&!|>'\"@`\x00-\x1f\x7f-\x9f]*\Z")


class Outcome(str, Enum):
    """What became of a line."""

    IMPORTED = "imported"
    CHANGED = "changed"
    LEFT_OUT = "left out"


class Entry(msgspec.Struct, frozen=True):
    """What became of a line at ``place``, ``file:line:column``, and why."""

    place: str
    outcome: Outcome
    what: str
    why: str = ""

    def __str__(self) -> str:
        """Return it on one line."""
        return f"{self.place}: {self.what}: {self.outcome.value}{f': {self.why}' if self.why else ''}"


def import_arni(path: Path, known: Mapping[str, Quantity]) -> tuple[str, tuple[Entry, ...]]:
    """Return the text of a reference, and what became of each line of the specification.

    Args:
        path: of the specification, in YAML.
        known: the signals, by key.

    Raises:
        DocumentError: the file cannot be read, is no YAML, or holds no specification.
    """
    try:
        content = read_bounded(path)
    except OSError as error:
        reason = error.strerror or str(error)
        raise DocumentError(f"cannot read it: {reason}", where=str(path), expected="a specification of ARNI") from None
    return imported(read_tree(content, str(path)), path.stem, known)


def imported(tree: Tree, name: str, known: Mapping[str, Quantity]) -> tuple[str, tuple[Entry, ...]]:
    """Return what :func:`import_arni` returns, of a specification that has been read.

    Raises:
        DocumentError: it holds no specification.
    """
    work = _Import(tree, known)
    for module, items in work.modules():
        work.module(module, items)
    slug = re.sub(r"[^a-z0-9_-]+", "-", name.lower()).strip("-_0123456789")[:60] or "imported"
    lines = ["kind: reference", f"name: {slug}", f"title: {_quoted(f'Imported from {Path(tree.shown).name}')}"]
    work.keep_together("\n".join([*lines, *work.text()]))
    lines += work.text()
    if reactions := reactions_of(tree.root, work.tell):
        lines += ["reactions:", *reactions]
    return "\n".join(lines) + "\n", tuple(sorted(work.entries, key=lambda entry: work.order[entry.place]))


class _Constraint:
    """A constraint of the reference as its lines."""

    def __init__(self, module: str, selected: Selected, place: str) -> None:
        self.module = module
        self.selected = selected
        self.place = place
        self.lines: dict[str, str] = {}


class _Import:
    """The import of one specification."""

    def __init__(self, tree: Tree, known: Mapping[str, Quantity]) -> None:
        self.entries: list[Entry] = []
        self.order: dict[str, tuple[int, int]] = {}
        self.constraints: list[_Constraint] = []
        self._tree = tree
        self._known = known
        self._seen: dict[tuple[tuple[str, str], ...], str] = {}
        self._said: dict[tuple[object, ...], tuple[_Constraint, str]] = {}
        self._specified = False

    def modules(self) -> Iterator[tuple[str, Items]]:
        """Yield the lists of the specification by name; the name of a list alone is empty."""
        node = self._specifications(self._tree.root)
        if has_countermeasures(self._tree.root) and not self._specified:
            return
        if isinstance(node, Items):
            yield "", node
            return
        if not isinstance(node, Table):
            found = "nothing" if node is None else described(node)
            raise DocumentError(
                f"the file holds {found}",
                where=self._tree.shown,
                expected="a list of ids such as `t!/topic` with their fields, alone or below `arni: specifications:`",
            )
        for name, items in node.nodes.items():
            if isinstance(items, Items):
                yield name, items
            else:
                self._tell(node.keys[name], Outcome.LEFT_OUT, name, f"it is {described(items)}, expected a list")

    def module(self, name: str, items: Items) -> None:
        """Import one list."""
        for item in items.nodes:
            if not isinstance(item, Table):
                self._tell(item.place, Outcome.LEFT_OUT, described(item), "expected `<id>:` with fields below it")
                continue
            for seuid, fields in item.nodes.items():
                self._entity(name, seuid, fields, item.keys[seuid])

    def keep_together(self, text: str) -> None:
        """Leave out patterns that contradict something else; ``text`` is the reference with all constraints."""
        clashes = {(clash.loser, clash.key): clash for clash in reversed(clashes_of(text, self._known))}
        for clash in clashes.values():
            loser, winner = self.constraints[clash.loser], self.constraints[clash.winner]
            seuid = " ".join(value for _, value in winner.selected.lines)
            del loser.lines[clash.key]
            place = self._said[loser.selected.lines, clash.key, clash.percentile == GREATEST][1]
            why = f"it contradicts the entry for {seuid} at {winner.place}, and ARNI ignored it, as it has no wildcards"
            self.entries = [
                Entry(place, Outcome.LEFT_OUT, one.what, why) if one.place == place else one for one in self.entries
            ]
        self.constraints = [one for one in self.constraints if one.lines]

    def text(self) -> Iterator[str]:
        """Yield the lines of the constraints."""
        yield "constraints:" if self.constraints else "constraints: []"
        module = ""
        for constraint in self.constraints:
            if constraint.module != module:
                module = constraint.module
                yield f"  # {' '.join(module.split())}"
            pairs = [*constraint.selected.lines, *constraint.lines.items()]
            for at, (key, value) in enumerate(pairs):
                yield f"  {'-' if at == 0 else ' '} {key}: {_quoted(value)}"

    def _specifications(self, node: Node | None) -> Node | None:
        for key in ("arni", "specifications"):
            if isinstance(node, Table):
                inner = next((one for one in (f"/{key}", key, f"{key}/") if one in node.nodes), "")
                both = next((one for one in ("/arni/specifications", "arni/specifications") if one in node.nodes), "")
                if both:
                    self._specified = True
                    self._others(node, both)
                    return node.nodes[both]
                if inner:
                    self._specified = self._specified or key == "specifications"
                    self._others(node, inner)
                    node = node.nodes[inner]
        return node

    def _others(self, table: Table, taken: str) -> None:
        for key, place in table.keys.items():
            if key != taken and key.strip("/") not in ("countermeasure", "arni/countermeasure"):
                self._tell(place, Outcome.LEFT_OUT, key, "it is not part of the specifications")

    def _entity(self, module: str, seuid: str, fields: Node, place: Place) -> None:
        selected = read_id(seuid)
        if isinstance(selected, str):
            self._tell(place, Outcome.LEFT_OUT, seuid, selected)
            return
        if not isinstance(fields, Table):
            self._tell(place, Outcome.LEFT_OUT, seuid, f"it has {described(fields)}, expected fields with limits")
            return
        if (first := self._seen.setdefault(selected.lines, self._where(place))) != self._where(place):
            why = f"it is also at {first}; ARNI kept only one of them, here both apply"
            self._tell(place, Outcome.CHANGED, seuid, why)
        if selected.odd:
            self._tell(place, Outcome.CHANGED, seuid, selected.odd)
        plain_, greatest = (_Constraint(module, selected, self._where(place)) for _ in range(2))
        alive = _Constraint(module, selected, self._where(place))
        for field, limits in fields.nodes.items():
            at = fields.keys[field]
            if field == ALIVE:
                self._alive(alive, seuid, limits, at)
                continue
            meaning = field_of(selected.kind, field)
            if meaning is None or not meaning.signal:
                why = meaning.note if meaning else _unknown(selected.kind, field)
                self._tell(at, Outcome.LEFT_OUT, f"{seuid} {field}", why)
                continue
            self._field(greatest if meaning.percentile else plain_, seuid, field, meaning, limits, at)
        self.constraints += [one for one in (plain_, greatest, alive) if one.lines]

    def _alive(self, constraint: _Constraint, seuid: str, node: Node, place: Place) -> None:
        seconds = number_of(node)
        if seconds is None or seconds < 0:
            self._tell(place, Outcome.LEFT_OUT, f"{seuid} {ALIVE}", f"it is {described(node)}, expected seconds")
            return
        lines = {"expected": "always", "for": amount_text(float(seconds), "s")}
        why = "`expected: always` with `for`; it is ok while it lives, which ARNI never said"
        note = self._first(constraint, "expected", lines, f"{seuid} {ALIVE}", place)
        if note is not None:
            self._tell(place, Outcome.CHANGED, f"{seuid} {ALIVE}", f"{why}; {note}" if note else why)

    def _field(
        self, constraint: _Constraint, seuid: str, field: str, meaning: ArniField, node: Node, place: Place
    ) -> None:
        what = f"{seuid} {field}"
        quantity = self._known[meaning.signal]
        try:
            found, notes = read_limits(node, meaning, quantity)
        except ValueError as error:
            self._tell(place, Outcome.LEFT_OUT, what, str(error))
            return
        words = limits_text(Limits(found, meaning.percentile), quantity.unit)
        said = self._first(constraint, meaning.signal, {meaning.signal: words}, what, place)
        if said is None:
            return
        notes = [note for note in (meaning.note, *notes, said) if note]
        outcome = Outcome.CHANGED if notes else Outcome.IMPORTED
        self._tell(place, outcome, what, "; ".join([f"`{meaning.signal}: {words}`", *notes]))

    def _first(self, constraint: _Constraint, key: str, lines: dict[str, str], what: str, place: Place) -> str | None:
        """Add lines, and return a note on it; None if they were not added and all was reported.

        What the specification said otherwise before is taken away.
        """
        theme = (constraint.selected.lines, key, lines.get(key, "").startswith("p100 "))
        note = ""
        if theme in self._said:
            before, where = self._said[theme]
            if before is constraint:
                self._tell(place, Outcome.LEFT_OUT, what, f"`{key}` has a range already, from {where}")
                return None
            if all(before.lines.get(one) == words for one, words in lines.items()):
                self._tell(place, Outcome.IMPORTED, what, f"the same is said at {where}")
                return None
            for one in lines:
                before.lines.pop(one, None)
            if not before.lines and before in self.constraints:
                self.constraints.remove(before)
            note = f"it replaces the entry at {where}, as in ARNI"
        self._said[theme] = (constraint, self._where(place))
        constraint.lines.update(lines)
        return note

    def tell(self, place: Place, outcome: str, what: str, why: str) -> None:
        """Keep what became of a line."""
        self._tell(place, Outcome(outcome), what, why)

    def _where(self, place: Place) -> str:
        where = str(self._tree.location(place))
        self.order[where] = (place.line, place.column)
        return where

    def _tell(self, place: Place, outcome: Outcome, what: str, why: str) -> None:
        self.entries.append(Entry(self._where(place), outcome, what, why))


def _unknown(kind: EntityKind, field: str) -> str:
    advice = did_you_mean(field, FIELDS[kind])
    return f"ARNI has no such field of a {kind.value}, and passed over it{f'. {advice}' if advice else ''}"


def _quoted(text: str) -> str:
    """Return a text as a value in YAML."""
    if _PLAIN.match(text) and text == text.strip() and text not in {"null", "Null", "NULL"}:
        return text
    return json.dumps(text, ensure_ascii=not text.isprintable())
