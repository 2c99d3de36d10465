"""Which names statements assign."""

from __future__ import annotations

from roslens.source.extract.ir.program import Assign, Branch, Loop, Member, Name, Statement


def assigned_names(body: tuple[Statement, ...]) -> set[str]:
    """Return the last names of what statements assign."""
    found: set[str] = set()
    waiting: list[Statement] = list(body)
    while waiting:
        one = waiting.pop()
        match one:
            case Assign(target=Name(name=name) | Member(name=name)):
                found.add(name)
            case Branch():
                waiting += [*one.then, *one.otherwise]
            case Loop():
                waiting += [*one.body, *one.update]
    return found
