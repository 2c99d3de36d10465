"""Blocks of CMake: conditions, of which all branches are evaluated that may be taken, loops, functions and macros."""

from __future__ import annotations

from roslens.source.extract.cmake_condition import Answer, answer
from roslens.source.extract.cmake_evaluation import MOST_ROUNDS, BlockHandler, Defined, Evaluation, ReturnedError
from roslens.source.extract.cmake_syntax import Block
from roslens.source.extract.cmake_value import items_of, reason_of


def _if(run: Evaluation, block: Block) -> None:
    branches: list[dict[str, str | None]] = []
    denied: list[str] = []
    first = ""
    usual: int | None = None
    undecided = False
    complete = False
    for opened, body in block.branches:
        found = Answer(True) if opened.name == "else" else answer(opened.arguments, run)
        if found.value is False:
            continue
        if found.value and not denied:
            run.run(body)
            return
        if not undecided and usual is None and found.likely is not False:
            usual = len(branches) if found.likely else None
            undecided = found.likely is None
        written = " ".join(argument.written for argument in opened.arguments)
        changes = run.perhaps(body, [*denied, *([written] if found.value is None else [])])
        if changes is not None:
            branches.append(changes)
        elif usual == len(branches):
            usual, undecided = None, True
        if found.value:
            complete = True
            break
        first = first or written
        denied.append(f"NOT ({written})")
    if not denied:
        return
    if not complete:
        if usual is None and not undecided:
            usual = len(branches)
        branches.append({})
    run.scope.merge(branches, usual if len(branches) > 1 else 0, run.either(first))


def _foreach(run: Evaluation, block: Block) -> None:
    opened, body = block.branches[0]
    arguments = run.expanded(opened.arguments)
    if not arguments:
        return
    name, items = arguments[0], _items(run, arguments[1:])
    if items is None or len(items) > MOST_ROUNDS:
        run.fail(f"foreach({name})", run.evidence(opened), "a loop of too many rounds, or over what is unknown")
        return
    _, before = run.scope.get(name)
    for item in items:
        run.step()
        perhaps = run.alternatives.get(item)
        try:
            if perhaps is None:
                run.set(name, item)
                run.run(body)
                continue
            for value in perhaps:
                run.conditions.append(reason_of(item))
                run.set(name, value)
                run.run(body)
                run.conditions.pop()
        except ReturnedError as signal:
            if signal.what == "break":
                break
            if signal.what != "continue":
                raise
    run.set(name, before)


def _items(run: Evaluation, arguments: list[str]) -> list[str] | None:
    if arguments and arguments[0] == "RANGE":
        numbers = [int(value) for value in arguments[1:4] if value.lstrip("-").isdecimal() and len(value) < 12]
        if len(numbers) != len(arguments) - 1 or not numbers:
            return None
        first, last = (0, numbers[0]) if len(numbers) == 1 else numbers[:2]
        step = abs(numbers[2]) if len(numbers) > 2 else 1
        if step == 0 or abs(last - first) // step > MOST_ROUNDS:
            return None
        return [str(one) for one in range(first, last + (1 if last >= first else -1), step if last >= first else -step)]
    if not arguments or arguments[0] != "IN":
        return arguments
    found: list[str] = []
    mode = ""
    for value in arguments[1:]:
        if value in ("LISTS", "ITEMS", "ZIP_LISTS"):
            mode = value
        elif mode == "LISTS":
            found.extend(items_of(run.get(value) or "", empty=True))
        elif mode == "ITEMS":
            found.append(value)
        else:
            return None
    return found


def _while(run: Evaluation, block: Block) -> None:
    opened, body = block.branches[0]
    for _ in range(MOST_ROUNDS):
        run.step()
        found = answer(opened.arguments, run)
        if found.value is None:
            changes = run.perhaps(body, [" ".join(argument.written for argument in opened.arguments)])
            run.scope.merge([changes or {}, {}], None, run.either("the rounds of a loop"))
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
    run.fail("while()", run.evidence(opened), "a loop of too many rounds, or over what is unknown")


def _define(run: Evaluation, block: Block) -> None:
    opened, body = block.branches[0]
    arguments = run.expanded(opened.arguments)
    if arguments:
        name = arguments[0].lower()
        run.functions[name] = Defined(name, opened.name == "macro", tuple(arguments[1:]), body, run.path)


def _plain(run: Evaluation, block: Block) -> None:
    run.run(block.branches[0][1])


BLOCKS: dict[str, BlockHandler] = {
    "if": _if,
    "foreach": _foreach,
    "while": _while,
    "function": _define,
    "macro": _define,
    "block": _plain,
}
