"""Blocks of CMake: conditions, of which all branches are evaluated that may be taken, loops, functions and macros."""

from __future__ import annotations

from roslens.source.extract.builds.cmake_condition import Answer, answer
from roslens.source.extract.builds.cmake_evaluation import BlockHandler, Defined, Evaluation
from roslens.source.extract.builds.cmake_limits import MOST_ROUNDS
from roslens.source.extract.builds.cmake_scope import Scope
from roslens.source.extract.builds.cmake_signals import ReturnedError
from roslens.source.extract.builds.cmake_syntax import Block, Body
from roslens.source.extract.builds.cmake_value import hole, is_unknown, items_of, reason_of


class _Branches:
    """The branches of an ``if()`` that may be taken: what each one changes, and which of them usually is."""

    def __init__(self, run: Evaluation) -> None:
        self.denied: list[str] = []
        self._run = run
        self._changes: list[dict[str, str | None]] = []
        self._left: list[tuple[str, str]] = []
        self._first = ""
        self._usual: int | None = None
        self._undecided = False

    def take(self, found: Answer, written: str, body: Body) -> None:
        """Run a branch as one that may be taken: its condition is unknown, or it is the last one that is left."""
        if self._usual is None and not self._undecided and found.likely is not False:
            self._usual = len(self._changes) if found.likely else None
            self._undecided = found.likely is None
        unknown = [written] if found.value is None else []
        changes = self._run.perhaps(body, [*self.denied, *unknown])
        if found.likely is not False:
            self._left.append((self._run.branch_left, " AND ".join([*self.denied, written])))
        if changes is not None:
            self._changes.append(changes)
        elif self._usual == len(self._changes):
            self._usual, self._undecided = None, True
        if unknown:
            self._first = self._first or written
            self.denied.append(f"NOT ({written})")

    def take_none(self) -> None:
        """Note that perhaps no branch is taken, which is usual where no other one is."""
        if self._usual is None and not self._undecided:
            self._usual = len(self._changes)
        self._changes.append({})

    def join(self) -> None:
        """Go on with what the branches have changed, and leave where one of them leaves."""
        variables = self._run.variables
        usual = self._usual if len(self._changes) > 1 else 0
        variables.scope.merge(self._changes, usual, variables.either(self._first))
        for way, reason in self._left:
            if way:
                self._run.leave(reason, way)


def _if(run: Evaluation, block: Block) -> None:
    branches = _Branches(run)
    for opened, body in block.branches:
        found = Answer(True) if opened.name == "else" else answer(opened.arguments, run)
        if found.value is False:
            continue
        if found.value and not branches.denied:
            run.run(body)
            return
        branches.take(found, " ".join(argument.written for argument in opened.arguments), body)
        if found.value:
            branches.join()
            return
    if branches.denied:
        branches.take_none()
        branches.join()


def _foreach(run: Evaluation, block: Block) -> None:
    opened, body = block.branches[0]
    arguments = run.variables.expanded(opened.arguments)
    if not arguments:
        return
    if "IN" in arguments and arguments[arguments.index("IN") + 1 :][:1] == ["ZIP_LISTS"]:
        at = arguments.index("IN")
        _zipped(run, block, arguments[:at], arguments[at + 2 :])
        return
    name, items = arguments[0], _items(run, arguments[1:])
    if items is None or len(items) > MOST_ROUNDS:
        _unknown_rounds(run, block, [name])
        return
    _, before = run.variables.scope.get(name)
    outer = len(run.conditions), run.left
    for item in items:
        if not _round(run, body, name, item, run.variables.alternatives.get(item)):
            break
    run.rejoin(outer, "break")
    run.variables.set(name, before)


def _round(run: Evaluation, body: Body, name: str, item: str, perhaps: tuple[str, ...] | None) -> bool:
    """Run a round of a loop, or one for each of what an item may be; return whether the loop goes on."""
    run.limits.step()
    outer = len(run.conditions), run.left
    try:
        if perhaps is None:
            run.variables.set(name, item)
            run.run(body)
        for value in perhaps or ():
            run.conditions.append(reason_of(item))
            run.variables.set(name, value)
            run.run(body)
            del run.conditions[outer[0] :]
    except ReturnedError as signal:
        if signal.what not in ("break", "continue"):
            raise
        return signal.what == "continue"
    finally:
        run.rejoin(outer, "continue")
    return True


def _zipped(run: Evaluation, block: Block, names: list[str], lists: list[str]) -> None:
    """Go over several lists at once: what the shorter have not is not set."""
    values = [run.variables.get(one) or "" for one in lists]
    several = names if len(names) > 1 else [f"{name}_{at}" for name in names for at in range(len(lists))]
    columns = [items_of(value, empty=True) for value in values]
    rounds = max(map(len, columns), default=0)
    if len(several) != len(lists) or rounds > MOST_ROUNDS or any(map(is_unknown, values)):
        _unknown_rounds(run, block, several)
        return
    before = [run.variables.scope.get(name)[1] for name in several]
    outer = len(run.conditions), run.left
    for at in range(rounds):
        for name, column in zip(several[1:], columns[1:], strict=True):
            run.variables.set(name, column[at] if at < len(column) else None)
        first = columns[0]
        if not _round(run, block.branches[0][1], several[0], first[at] if at < len(first) else "", None):
            break
    run.rejoin(outer, "break")
    for name, value in zip(several, before, strict=True):
        run.variables.set(name, value)


def _unknown_rounds(run: Evaluation, block: Block, names: list[str]) -> None:
    """Run a loop once as one that may not be run: what it sets is no longer known."""
    opened, body = block.branches[0]
    shown = " ".join(names)
    run.fail(f"foreach({shown})", run.evidence(opened), "a loop with too many iterations, or over unknown items")
    before = [run.variables.scope.get(name)[1] for name in names]
    for name in names:
        run.variables.set(name, hole(f"{name} of foreach()"))
    unsure = f"the iterations of foreach({shown})"
    try:
        changes = run.perhaps(body, [unsure])
        run.variables.scope.merge([changes or {}, {}], None, run.variables.either(unsure))
    finally:
        for name, value in zip(names, before, strict=True):
            run.variables.set(name, value)


def _range(arguments: list[str]) -> list[str] | None:
    """Return the numbers of a range, both ends among them; None where it is none, or too long."""
    numbers = [int(value) for value in arguments[:3] if value.lstrip("-").isdecimal() and len(value) < 12]
    if len(numbers) != len(arguments) or not numbers:
        return None
    first, last = (0, numbers[0]) if len(numbers) == 1 else numbers[:2]
    step = abs(numbers[2]) if len(numbers) > 2 else 1
    if step == 0 or abs(last - first) // step > MOST_ROUNDS:
        return None
    way = 1 if last >= first else -1
    return [str(one) for one in range(first, last + way, step * way)]


def _items(run: Evaluation, arguments: list[str]) -> list[str] | None:
    if arguments and arguments[0] == "RANGE":
        return _range(arguments[1:])
    if not arguments or arguments[0] != "IN":
        return arguments
    found: list[str] = []
    mode = ""
    for value in arguments[1:]:
        if value in ("LISTS", "ITEMS", "ZIP_LISTS"):
            mode = value
        elif mode == "LISTS":
            found.extend(items_of(run.variables.get(value) or "", empty=True))
        elif mode == "ITEMS":
            found.append(value)
        else:
            return None
    return found


def _while(run: Evaluation, block: Block) -> None:
    outer = len(run.conditions), run.left
    try:
        _rounds(run, block)
    finally:
        run.rejoin(outer, "break")


def _rounds(run: Evaluation, block: Block) -> None:
    opened, body = block.branches[0]
    for _ in range(MOST_ROUNDS):
        run.limits.step()
        found = answer(opened.arguments, run)
        if found.value is None:
            changes = run.perhaps(body, [" ".join(argument.written for argument in opened.arguments)])
            run.variables.scope.merge([changes or {}, {}], None, run.variables.either("the iterations of a loop"))
            return
        if not found.value:
            return
        try:
            run.run(body)
        except ReturnedError as signal:
            if signal.what == "break":
                return
            if signal.what != "continue":
                raise
    run.fail("while()", run.evidence(opened), "a loop with too many iterations, or over unknown items")


def _define(run: Evaluation, block: Block) -> None:
    opened, body = block.branches[0]
    arguments = run.variables.expanded(opened.arguments)
    if arguments:
        name = arguments[0].lower()
        run.functions[name] = Defined(name, opened.name == "macro", tuple(arguments[1:]), body, run.path)


def _block(run: Evaluation, block: Block) -> None:
    opened, body = block.branches[0]
    arguments = run.variables.expanded(opened.arguments)
    at = arguments.index("PROPAGATE") if "PROPAGATE" in arguments else len(arguments)
    if "SCOPE_FOR" in arguments[:at] and "VARIABLES" not in arguments[:at]:
        run.run(body)
        return
    outer = run.variables.scope
    run.variables.scope = inner = Scope(outer, block=True)
    try:
        run.run(body)
    finally:
        run.variables.scope = outer
        for name in arguments[at + 1 :]:
            outer.set(name, inner.get(name)[1])


BLOCKS: dict[str, BlockHandler] = {
    "if": _if,
    "foreach": _foreach,
    "while": _while,
    "function": _define,
    "macro": _define,
    "block": _block,
}
