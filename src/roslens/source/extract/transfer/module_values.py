"""Variables of modules of Python that take more than one statement: lists that are filled, what a branch sets.

Only the statements that set or change a variable are followed, not what else the module does.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from roslens.source.extract.domain.abstract_value import Value
from roslens.source.extract.ir.program import (
    Assign,
    Branch,
    Call,
    Evaluate,
    Expression,
    Item,
    Loop,
    Member,
    Name,
    Program,
    Sequence,
    Statement,
)
from roslens.source.extract.transfer.changed_values import CHANGING

if TYPE_CHECKING:
    from roslens.source.extract.transfer.context import Context

_ADDING = frozenset({"append", "add"})


def changes_of(program: Program) -> dict[str, tuple[Statement, ...]]:
    """Return the statements outside of functions that set or change each variable for which one is not enough."""
    found: dict[str, list[Statement]] = {}
    for statement in program.body:
        for name in dict.fromkeys(_changed(statement)):
            found.setdefault(name, []).append(statement)
    return {name: tuple(all_) for name, all_ in found.items() if not _says_it_all(all_)}


def _says_it_all(statements: list[Statement]) -> bool:
    match statements:
        case [Assign()]:
            return True
    return False


def _is_set_to(statement: Statement, value: Expression) -> bool:
    match statement:
        case Assign():
            return statement.value is value
    return False


def module_value(ctx: Context, path: str, name: str, first: Expression) -> tuple[Value] | None:
    """Return what a variable of a module is after all that changes it; None if a single statement sets it.

    Args:
        ctx: the evaluation.
        path: of the module.
        name: of the variable.
        first: what it is set to first; another one of this name is an attribute of a class.
    """
    memo = ctx.index.memo
    known = memo.of_modules.get(path)
    if known is None:
        known = memo.of_modules[path] = changes_of(ctx.index.programs[path])
    statements = known.get(name, ())
    if not any(_is_set_to(one, first) for one in statements):
        return None
    outer, changes = ctx.state.frame, ctx.state.store
    ctx.state.frame, ctx.state.store = ctx.state.frame_of(path, ""), type(changes)()
    ctx.state.frame.depth, ctx.state.store.refined = len(ctx.state.conditions), changes.refined
    try:
        ctx.block(statements)
        return (ctx.state.frame.names[name],) if name in ctx.state.frame.names else None
    finally:
        ctx.state.frame, ctx.state.store = outer, changes


def _changed(statement: Statement) -> list[str]:
    """Return the names of the variables that a statement sets or changes."""
    match statement:
        case Assign():
            return _roots(statement.target) if statement.value is not None else []
        case Evaluate(expression=Call(function=Member(of=of, name=name))) if name in CHANGING or name in _ADDING:
            return _roots(of)
        case Branch():
            return [name for one in (*statement.then, *statement.otherwise) for name in _changed(one)]
        case Loop():
            inside = [name for one in statement.body for name in _changed(one)]
            return [*inside, *(_roots(statement.target) if statement.target is not None else [])]
    return []


def _roots(target: Expression) -> list[str]:
    match target:
        case Item(of=of) | Member(of=of):
            return _roots(of)
        case Sequence(items=items):
            return [name for one in items for name in _roots(one)]
        case Name(name=name):
            return [name]
    return []
