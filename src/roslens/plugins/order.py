"""The order in which plug-ins run: each after those that give what it needs."""

from __future__ import annotations

import os
from collections.abc import Callable, Collection, Mapping, Sequence

import msgspec

from roslens.model.failure import Failure
from roslens.plugins.contract_failures import TOOL
from roslens.plugins.member import Member
from roslens.plugins.nearest import did_you_mean

PROGRAM = "program:"
PLUGIN = "plugin:"


class Unavailable(msgspec.Struct, frozen=True):
    """A built-in plug-in whose program is not installed: nothing is wrong, it just cannot help."""

    plugin: str
    program: str


class Ordered(msgspec.Struct, frozen=True):
    """The plug-ins that can run, in order; those that cannot, and why."""

    members: tuple[Member, ...]
    failures: tuple[Failure, ...] = ()
    unavailable: tuple[Unavailable, ...] = ()


def order(
    members: Sequence[Member],
    provided: Collection[str] | None = (),
    *,
    is_installed: Callable[[str], bool] | None = None,
) -> Ordered:
    """Sort plug-ins by what they need, and leave out those that will not get it.

    Args:
        members: plug-ins in any order.
        provided: keys of quantities that are measured without any plug-in; None when that is not known,
            so that no quantity is missing.
        is_installed: whether there is a program of that name; None means to look for it.
    """
    there = is_installed or _on_search_path
    failures: list[Failure] = []
    unavailable: list[Unavailable] = []
    able = dict(sorted({member.name: member for member in members}.items()))
    for member in list(able.values()):
        missing = [need for need in member.manifest.needs if need.startswith(PROGRAM) and not there(_program(need))]
        if missing:
            del able[member.name]
            if member.builtin:
                unavailable.append(Unavailable(member.name, _program(missing[0])))
            else:
                failures.append(_missing_program(member.name, _program(missing[0])))
    while lacking := _lacking(able, provided):
        for name, need in lacking.items():
            failures.append(_missing(name, need, able, provided or ()))
            del able[name]
    ready, stuck = _sorted(able)
    failures.extend(_cycle(name, able, stuck) for name in stuck)
    return Ordered(tuple(ready), tuple(failures), tuple(unavailable))


def generations(members: Sequence[Member]) -> tuple[tuple[Member, ...], ...]:
    """Return plug-ins in groups: those of a group need nothing of each other, only of earlier groups."""
    ranked = {member.name: member for member in members}
    depth: dict[str, int] = {}
    for name in _known_order(ranked):
        above = [depth[giver] for giver in _awaited(name, ranked) if giver in depth]
        depth[name] = max(above, default=-1) + 1
    groups = [
        tuple(ranked[name] for name in sorted(ranked) if depth.get(name) == level)
        for level in range(max(depth.values(), default=-1) + 1)
    ]
    return tuple(groups)


def _known_order(members: Mapping[str, Member]) -> list[str]:
    """Return names so that each follows those it needs; those of a cycle come last."""
    ready, stuck = _sorted(members)
    return [*(member.name for member in ready), *stuck]


def _sorted(able: Mapping[str, Member]) -> tuple[list[Member], list[str]]:
    waits = {name: _awaited(name, able) - {name} for name in able}
    ready: list[Member] = []
    while free := sorted(name for name, others in waits.items() if not others):
        for name in free:
            ready.append(able[name])
            del waits[name]
        for others in waits.values():
            others.difference_update(free)
    return ready, sorted(waits)


def _givers(able: Mapping[str, Member]) -> dict[str, set[str]]:
    """Return who gives what: by quantity key and by ``plugin:NAME``."""
    givers: dict[str, set[str]] = {PLUGIN + name: {name} for name in able}
    for name, member in able.items():
        for quantity in member.manifest.quantities:
            givers.setdefault(quantity.key, set()).add(name)
    return givers


def _lacking(able: Mapping[str, Member], provided: Collection[str] | None) -> dict[str, str]:
    givers = _givers(able)
    lacking: dict[str, str] = {}
    for name, member in able.items():
        for need in member.manifest.needs:
            given = need.startswith(PROGRAM) or _base(need) in givers
            known = not need.startswith(PLUGIN) if provided is None else need in provided
            if not given and not known:
                lacking.setdefault(name, need)
    return lacking


def _base(need: str) -> str:
    """Return the key that a folded quantity (``key.max``) comes from, or the need itself."""
    for fold in (".sum", ".mean", ".max", ".min"):
        if need.endswith(fold):
            return need.removesuffix(fold)
    return need


def _on_search_path(program: str) -> bool:
    """Look for a program; what the standard library has for it imports all compressors."""
    folders = os.environ.get("PATH", os.defpath).split(os.pathsep)
    return any(os.access(os.path.join(folder, program), os.X_OK) for folder in folders)  # noqa: PTH118 - no Path a folder


def _program(need: str) -> str:
    return need.removeprefix(PROGRAM)


def _missing_program(name: str, program: str) -> Failure:
    return Failure(
        tool=TOOL,
        what=f"plug-in {name!r} needs the program {program!r}, which is not installed",
        expected=f"{program!r} on the search path",
        advice=f"Install {program}, or disable {name}",
    )


def _missing(name: str, need: str, able: Mapping[str, Member], provided: Collection[str]) -> Failure:
    if need.startswith(PLUGIN):
        what = f"plug-in {name!r} needs plug-in {need.removeprefix(PLUGIN)!r}, which is missing or cannot run"
    else:
        what = f"plug-in {name!r} needs quantity {need!r}, which nothing measures"
    near = did_you_mean(need, (*_givers(able), *provided))
    return Failure(tool=TOOL, what=what, advice=near or f"Add a plug-in that provides it, or disable {name}")


def _cycle(name: str, able: Mapping[str, Member], stuck: Sequence[str]) -> Failure:
    partners = sorted(other for other in _awaited(name, able) if other != name and other in stuck)
    for other in partners:
        if name in _all_awaited(other, able):
            return Failure(
                tool=TOOL,
                what=f"plug-in {name!r} and plug-in {other!r} wait for each other",
                expected="needs without a cycle",
                advice=f"Disable one of {', '.join(stuck)}",
            )
    return Failure(
        tool=TOOL,
        what=f"plug-in {name!r} waits for plug-in {partners[0]!r}, which cannot run",
        expected="needs without a cycle",
        advice=f"Disable one of {', '.join(stuck)}",
    )


def _awaited(name: str, able: Mapping[str, Member]) -> set[str]:
    givers = _givers(able)
    return {giver for need in able[name].manifest.needs for giver in givers.get(_base(need), ())}


def _all_awaited(name: str, able: Mapping[str, Member]) -> set[str]:
    seen: set[str] = set()
    ahead = [name]
    while ahead:
        for other in _awaited(ahead.pop(), able) - seen:
            seen.add(other)
            ahead.append(other)
    return seen
