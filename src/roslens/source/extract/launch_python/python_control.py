"""Branches and loops of a Python launch file: both ways of an open condition, and ways out of loops and functions."""

from __future__ import annotations

import ast
from typing import Any, Protocol

from roslens.source.extract.launch_python.python_arguments import items_of
from roslens.source.extract.launch_python.python_value import Either, Made, Unknown
from roslens.source.extract.launch_python.python_weight import TooLongError

MOST_TURNS = 1_000


class Left:
    """How a block was left: by ``return`` with a value, ``break``, ``continue`` or ``raise``."""

    def __init__(self, kind: str, value: Any = None) -> None:
        self.kind = kind
        self.value = value


class Ways:
    """The ways out of one function that conditions decide which are open.

    Attributes:
        start: how many notes were there before it was called.
        found: kind and condition of each way.
        returned: what those that return give back, with their conditions.
    """

    def __init__(self, start: int = 0) -> None:
        self.start = start
        self.found: list[tuple[str, str, dict[str, Any]]] = []
        self.returned: list[tuple[str, Any]] = []

    def result(self, value: Any) -> Any:
        """Return what the function returns where its last statement gives a value."""
        for note, one in reversed(self.returned):
            value = Either(note, one, value)
        return value


class Followed(Protocol):
    """What evaluates a launch file, as its branches and loops see it."""

    notes: list[str]
    ways: Ways

    @property
    def held(self) -> dict[str, Any]:
        """The innermost names."""

    def block(self, body: list[ast.stmt]) -> Left | None:
        """Follow statements in order; return how they were left, None where they were not."""

    def put(self, target: ast.expr, value: Any) -> None:
        """Put a value where an expression says."""

    def truth(self, value: Any) -> bool | None:
        """Return whether a value is true; None where that is unknown."""

    def value(self, node: ast.expr) -> Any:
        """Return the value of an expression."""


def noted(run: Followed, note: str, body: list[ast.stmt]) -> Left | None:
    """Follow a block under a condition; what it leaves for sure is left under that condition."""
    start, since = len(run.notes), len(run.ways.found)
    run.notes.append(note)
    try:
        return run.block(body)
    finally:
        _behind(run, start, since, {"break", "continue", "raise", "return"})


def _behind(run: Followed, start: int, since: int, kinds: set[str]) -> None:
    """Note of what follows that no way out of some kinds was taken; forget the others."""
    del run.notes[start:]
    run.ways.found[since:] = [one for one in run.ways.found[since:] if one[0] in kinds]
    run.notes += [f"not ({note})" if " and " in note else f"not {note}" for _, note, _held in run.ways.found[since:]]


def _leave(run: Followed, note: str, left: Left, held: dict[str, Any]) -> None:
    """Keep that a block was left under a condition; a launch file that raises starts nothing that could be told."""
    if left.kind == "raise":
        return
    whole = " and ".join([*run.notes[run.ways.start :], note])
    run.ways.found.append((left.kind, whole, held))
    if left.kind == "return":
        run.ways.returned.append((whole, left.value))


def branch(run: Followed, statement: ast.If) -> Left | None:
    """Follow the way that is taken, or both of them."""
    holds = run.truth(run.value(statement.test))
    if holds is not None:
        return run.block(statement.body if holds else statement.orelse)
    note, names = ast.unparse(statement.test), run.held
    before = dict(names)
    then = noted(run, note, statement.body)
    came = dict(names)
    names.clear()
    names.update(before)
    other = noted(run, f"not {note}", statement.orelse)
    if then is None and other is None:
        _join(names, came, note)
        return None
    if then is not None and other is not None:
        return _both(run, note, (then, came), (other, dict(names)))
    if then is not None:
        _leave(run, note, then, came)
        run.notes += [f"not {note}"] * (then.kind != "raise")
        return None
    gone = dict(names)
    names.clear()
    names.update(came)
    if other is not None:
        _leave(run, f"not {note}", other, gone)
        run.notes += [note] * (other.kind != "raise")
    return None


def _both(run: Followed, note: str, first: tuple[Left, dict[str, Any]], second: tuple[Left, dict[str, Any]]) -> Left:
    """Return how both ways of a condition leave a block, where each does."""
    (then, came), (other, gone) = first, second
    if then.kind == other.kind:
        _join(run.held, came, note)
        return Left(then.kind, Either(note, then.value, other.value) if then.kind == "return" else None)
    if then.kind in ("return", "break", "raise"):
        _leave(run, note, then, came)
        return other
    _leave(run, f"not {note}", other, gone)
    run.held.clear()
    run.held.update(came)
    return then


def _join(names: dict[str, Any], came: dict[str, Any], note: str) -> None:
    """Let names hold what either way came to, ``came`` being that where the condition holds."""
    for name, one in came.items():
        other = names.get(name, one)
        if one is other or (type(one) is type(other) and isinstance(one, str | int | float) and one == other):
            names[name] = one
        else:
            names[name] = _filled(one, other) or Either(note, one, other)


def _filled(one: Any, other: Any) -> Any:
    """Return the longer list where one goes on where the other ends with what keeps its conditions; else None."""
    if not isinstance(one, list) or not isinstance(other, list):
        return None
    less, more = sorted((one, other), key=len)
    begins = all(a is b for a, b in zip(less, more, strict=False))
    return more if begins and all(isinstance(item, Made) for item in more[len(less) :]) else None


def _join_left(run: Followed, since: int, left: str) -> None:
    """Let names hold what they held where a turn or loop was left too."""
    for kind, note, held in run.ways.found[since:]:
        if kind == left:
            _join(run.held, held, note)


def _turn(
    run: Followed, statement: ast.For | ast.AsyncFor | ast.While, start: int, since: int
) -> tuple[bool, Left | None]:
    """Follow one turn of a loop; return whether it ends the loop, and how what is around the loop is left."""
    left = run.block(statement.body)
    _join_left(run, since, "continue")
    _behind(run, start, since, {"break", "return", "raise"})
    if left is None or left.kind == "continue":
        return False, None
    _join_left(run, since, "break")
    _behind(run, start, since, {"return", "raise"})
    return True, None if left.kind == "break" else left


def loop(run: Followed, statement: ast.For | ast.AsyncFor) -> Left | None:
    """Go through what is known, or once through what is not."""
    items = items_of(run.value(statement.iter))
    start, since = len(run.notes), len(run.ways.found)
    if items is None:
        return _unknown(run, statement, f"for each of {ast.unparse(statement.iter)}")
    for item in items:
        run.put(statement.target, item)
        ends, left = _turn(run, statement, start, since)
        if ends:
            return left
    return _else(run, statement, start, since)


def repeat(run: Followed, statement: ast.While) -> Left | None:
    """Go through a loop while its condition is known to hold."""
    start, since = len(run.notes), len(run.ways.found)
    for _ in range(MOST_TURNS):
        holds = run.truth(run.value(statement.test))
        if holds is False:
            return _else(run, statement, start, since)
        if holds is None:
            return _unknown(run, statement, ast.unparse(statement.test))
        ends, left = _turn(run, statement, start, since)
        if ends:
            return left
    raise TooLongError


def _unknown(run: Followed, statement: ast.For | ast.AsyncFor | ast.While, note: str) -> Left | None:
    """Follow one turn for all, of which there may be none."""
    names, start, since = run.held, len(run.notes), len(run.ways.found)
    if not isinstance(statement, ast.While):
        run.put(statement.target, Unknown(f"each of {ast.unparse(statement.iter)}"))
    before = dict(names)
    left = noted(run, note, statement.body)
    came = dict(names)
    names.clear()
    names.update(before)
    _behind(run, start, since, {"break", "return", "raise"})
    if left is not None and left.kind in ("return", "raise"):
        _leave(run, note, left, came)
        run.notes += [f"not {note}"] * (left.kind != "raise")
    elif left is None or left.kind != "raise":
        _join(names, came, note)
    return _else(run, statement, start, since)


def _else(run: Followed, statement: ast.For | ast.AsyncFor | ast.While, start: int, since: int) -> Left | None:
    """Follow what stands behind ``else``: where the loop may have been left, under the condition that it was not."""
    broken = any(one[0] == "break" for one in run.ways.found[since:])
    before = run.ways.found[since:]
    kept = run.notes[start:] if not broken else []
    _behind(run, start, since, {"return", "raise"})
    run.notes += [one for one in kept if one not in run.notes[start:]]
    left = None
    if statement.orelse and not broken:
        return run.block(statement.orelse)
    if statement.orelse:
        left = noted(run, "no break", statement.orelse)
    if left is not None:
        _leave(run, "no break", left, dict(run.held))
        run.notes.append("not no break")
    for kind, note, held in before:
        if kind == "break":
            _join(run.held, held, note)
    return None
