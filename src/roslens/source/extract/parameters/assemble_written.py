"""The value that a parameter of ROS 1 has after code has written it, one write after the other.

A write that is sure decides; one that is not (under a condition, in a callback, of an unknown value) makes the value
less sure. A server of dynamic_reconfigure takes what is set as far as it fits, else the default, and writes it all
(dynamic_reconfigure, server.h and server.py; of numbers roscpp, param.cpp).
"""

from __future__ import annotations

import math
from collections.abc import Iterable

import msgspec

from roslens.model.configuration import ConfiguredParameter, Origin, Proof
from roslens.source.extract.facts.node_facts import ParameterFact, Sure
from roslens.source.extract.parameters.assemble_proof import proof_of
from roslens.source.extract.symbolic.text import Conditions, Text

_NUMBERS = frozenset({"int", "double"})
_HALF = 0.5


class Write(msgspec.Struct, frozen=True):
    """One write of a parameter.

    Attributes:
        fact: what code says of it.
        value: what is written, or the default; None where there is none.
        sure: how sure that value is.
    """

    fact: ParameterFact
    value: Text | None
    sure: Sure


def after_writes(parameter: ConfiguredParameter, writes: Iterable[Write]) -> ConfiguredParameter:
    """Return a parameter with the value that it has after writes, in the order in which code makes them."""
    before = parameter.value
    for write in writes:
        if write.fact.writer is None:
            continue
        parameter = _served(parameter, write) if write.fact.access == "declared" else _written(parameter, write)
    changed = parameter.set_by is not None and parameter.value != before
    return msgspec.structs.replace(parameter, set_value=before) if changed else parameter


def _proof(write: Write, **changes: str) -> Proof:
    assert write.fact.writer is not None  # noqa: S101 - asked before
    proof = proof_of(write.fact.writer, Origin.CODE)
    worse = write.sure is not Sure.CERTAIN and proof.sure == Sure.CERTAIN.value
    return msgspec.structs.replace(proof, **({"sure": write.sure.value} if worse else {}), **changes)


def _written(parameter: ConfiguredParameter, write: Write) -> ConfiguredParameter:
    value = None if write.value is None else write.value.known
    proof, conditions = _proof(write), write.fact.conditions
    has_value = parameter.set_by is not None or parameter.written_by is not None
    if not has_value or (proof.sure == Sure.CERTAIN.value and not conditions):
        return _decided(parameter, write, proof)
    if value is not None and value == parameter.value:
        return parameter
    shown = "another value" if write.value is None else f"`{write.value}`"
    how = _conditional(f"{shown} may be written{', ' * bool(proof.how)}{proof.how}", conditions)
    return msgspec.structs.replace(
        parameter, written_by=msgspec.structs.replace(proof, how=how, sure=Sure.LIKELY.value)
    )


def _decided(parameter: ConfiguredParameter, write: Write, proof: Proof) -> ConfiguredParameter:
    """Return a parameter that has the value of a write, as it is sure or the first."""
    conditions, sure, how, value = write.fact.conditions, proof.sure, proof.how, None
    if write.value is not None:
        value = write.value.known
        how = how if value is not None else str(write.value)
    if value is None:
        sure = Sure.POSSIBLE.value
    elif conditions:
        sure = Sure.LIKELY.value
    proof = msgspec.structs.replace(proof, how=_conditional(how, conditions), sure=sure)
    return msgspec.structs.replace(parameter, value=value, type=parameter.type or write.fact.type, written_by=proof)


def _conditional(how: str, conditions: Conditions) -> str:
    held = f"only if {' and '.join(map(str, conditions))}" if conditions else ""
    return ", ".join(piece for piece in (how, held) if piece)


def _served(parameter: ConfiguredParameter, write: Write) -> ConfiguredParameter:
    """Return what a server makes of a parameter: what is set where it fits, in its range; else the default."""
    fact = write.fact
    default = None if write.value is None else write.value.known
    if fact.conditions and parameter.set_by is not None:
        return parameter
    assert fact.writer is not None  # noqa: S101 - asked before
    python = fact.writer.path.endswith(".py")
    if parameter.set_by is None and parameter.written_by is None:
        first = default if default is None else taken_by_server(default, fact.type, fact, default, python=python)[0]
        return msgspec.structs.replace(parameter, value=first, written_by=_proof(write))
    if parameter.value is None:
        return parameter
    before = parameter.value
    kind = parameter.set_type if parameter.set_by is not None and parameter.written_by is None else parameter.type
    taken, how = taken_by_server(before, kind, fact, default, python=python)
    if taken == before:
        return parameter
    return msgspec.structs.replace(parameter, value=taken, written_by=_proof(write, how=how))


def taken_by_server(
    value: str, kind: str, fact: ParameterFact, default: str | None, *, python: bool
) -> tuple[str | None, str]:
    """Return what a server makes of a value that is set, and in words why it is another one; None is unknown.

    Args:
        value: that is set.
        kind: its type.
        fact: what the ``.cfg`` file declares.
        default: of it.
        python: whether the server is one of rospy, which converts nothing.
    """
    wanted = fact.type
    if not wanted or not kind:
        return value, ""
    if kind != wanted and not {kind, wanted} <= _NUMBERS:
        return (value, "") if python else (default, f"`{value}` is not of type {wanted}, so the default is used")
    if wanted not in _NUMBERS:
        return value, ""
    try:
        number = float(value)
    except ValueError:
        return value, ""
    if (limited := _limited(value, number, fact.range)) is not None:
        return limited
    if kind == wanted or python:
        return value, ""
    converted = repr(number) if wanted == "double" else str(_rounded(number))
    return converted, f"`{value}` is converted to {wanted}"


def _limited(value: str, number: float, range_: str) -> tuple[str, str] | None:
    """Return the end of a range that a number is beyond, and that in words; None where it is within."""
    least, _, most = range_.partition("..")
    if least and number < float(least):
        return least, f"`{value}` is below the minimum"
    if most and number > float(most):
        return most, f"`{value}` is above the maximum"
    return None


def _rounded(number: float) -> int:
    """Return the whole number that roscpp makes of another one (param.cpp): of a negative one always the lower one."""
    return math.floor(number) if math.fmod(number, 1.0) < _HALF else math.ceil(number)
