"""Whether messages and services that reactions name exist, and have the fields that are filled, without a running ROS.

Definitions are those of packages that are installed here, and else the messages that rosbags brings (of ROS 1 Noetic
and the latest ROS 2). Of a package that neither has, nothing is said: ROS itself is asked before anything begins.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from functools import cache
from pathlib import Path
from typing import Any

import msgspec

from roslens.model.acting.action_kind import ArgumentType, action_kind
from roslens.model.acting.reaction import ActionCall, Reaction
from roslens.model.errors import DocumentError
from roslens.plugins.nearest import did_you_mean

_FOLDERS = ("msg", "srv")
_CALLS = {"publish": "msg", "call": "srv"}
_Fields = Mapping[str, "str | None"]
"""Name of each field, with the type of its message; None of what is a number, a text or a list."""


class Unchecked(msgspec.Struct, frozen=True):
    """A type of which no definition is here, and where it is named."""

    type: str
    place: str


def folders_of(environment: Mapping[str, str]) -> tuple[Path, ...]:
    """Return the folders that have a folder for each installed package of ROS."""
    shares = [Path(one) / "share" for one in environment.get("AMENT_PREFIX_PATH", "").split(":") if one]
    plain = [Path(one) for one in environment.get("ROS_PACKAGE_PATH", "").split(":") if one]
    return tuple(dict.fromkeys((*shares, *plain)))


def unchecked_types(reactions: Iterable[Reaction], folders: Sequence[Path]) -> list[Unchecked]:
    """Look at every type that actions name; return those of which no definition is here.

    Raises:
        DocumentError: a package that is known has no such type, or a type no such field.
    """
    found = []
    for call in (step.action for reaction in reactions for step in reaction.steps):
        kind = action_kind(call.kind)
        named = [one for one in kind.arguments if one.type is ArgumentType.INTERFACE] if kind is not None else []
        for argument in named:
            type_ = str(call.arguments.get(argument.name, ""))
            if type_ and not _known(call, type_, folders):
                found.append(Unchecked(type_, call.place))
    return found


def _known(call: ActionCall, type_: str, folders: Sequence[Path]) -> bool:
    """Return whether there is a definition of a type; refuse it where its package is here without it."""
    folder = _CALLS.get(call.kind, "msg")
    package, _, name = type_.partition("/")
    name = name.rpartition("/")[2]
    beside = _installed(package, folder, folders)
    if not beside and folder == "msg":
        beside = {one.rpartition("/")[2] for one in _brought() if one.startswith(f"{package}/")}
    if not beside:
        return False
    if name not in beside:
        what = "message" if folder == "msg" else "service"
        raise DocumentError(
            f"no {what} {type_!r}: the package {package!r} that is known here has none of that name",
            where=call.place,
            expected=f"one of its {len(beside)} {what}s",
            advice=did_you_mean(name, beside),
        )
    fields = call.arguments.get("fields")
    if isinstance(fields, Mapping) and folder == "msg":
        _check(fields, f"{package}/msg/{name}", call.place, type_)
    return True


def _installed(package: str, folder: str, folders: Sequence[Path]) -> set[str]:
    return {one.stem for share in folders for one in (share / package / folder).glob(f"*.{folder}")}


def _check(fields: Mapping[str, Any], type_: str, place: str, said: str) -> None:
    known = _brought().get(type_)
    if known is None:
        return
    for name, value in fields.items():
        if name not in known:
            raise DocumentError(
                f"{said} has no field {name!r}", where=place, expected=f"one of {', '.join(known)}",
                advice=did_you_mean(name, known),
            )  # fmt: skip
        inner = known[name]
        if isinstance(value, Mapping) and inner is not None:
            _check(value, inner, place, f"{name!r} of {said}")


@cache
def _brought() -> dict[str, _Fields]:
    """Return the messages that rosbags brings, ROS 2 before ROS 1: a field that either has is one."""
    from rosbags.typesys import Stores, get_typestore

    found: dict[str, dict[str, str | None]] = {}
    for store in (Stores.LATEST, Stores.ROS1_NOETIC):
        for name, (_, fields) in get_typestore(store).fielddefs.items():
            found.setdefault(name, {}).update(_fields(fields))
    return dict(found)


def _fields(fields: Iterable[tuple[str, Any]]) -> Iterator[tuple[str, str | None]]:
    from rosbags.interfaces import Nodetype

    for name, (kind, of) in fields:
        yield name, str(of) if kind is Nodetype.NAME else None
