"""Functions that call a service and wait for its answer."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

import msgspec

from roslens.model.configuration import Proof
from roslens.source.extract.ir.program import Call, Function, Member, Name, Program
from roslens.source.rules.graph.surroundings import Wait

_SENT = frozenset({"async_send_request", "call_async"})
_SPINS = "spin_until_future_complete"
_TAKES = frozenset({"get", "wait"})
"""Of a future, without a time after which they give up."""


def waits(programs: Mapping[str, Program]) -> Iterator[Wait]:
    """Yield each call of a service after which its function waits for the answer without an end."""
    for path in sorted(programs):
        for function in programs[path].functions:
            yield from _of_function(path, function, programs[path].language)


def _of_function(path: str, function: Function, language: str) -> Iterator[Wait]:
    calls = [(_last(one), one) for one in _calls(function)]
    name = function.qualified_name
    for called, one in calls:
        if language == "python" and called == "call" and isinstance(one.function, Member) and len(one.arguments) == 1:
            yield Wait(name, Proof(path, one.line, one.column, "taken to be of a client", "likely"))
    how = next((called for called, one in calls if called == _SPINS or _takes(called, one, language)), "")
    for called, one in calls:
        if how and called in _SENT:
            yield Wait(name, Proof(path, one.line, one.column), f"{called}() and {how}()")


def _takes(called: str, one: Call, language: str) -> bool:
    return language == "cpp" and called in _TAKES and not one.arguments and isinstance(one.function, Member)


def _last(one: Call) -> str:
    if isinstance(one.function, Name | Member):
        return one.function.name.rpartition(".")[2]
    return ""


def _calls(function: Function) -> Iterator[Call]:
    """Yield all calls in a function, in source order."""
    found = []
    waiting: list[object] = [function.body]
    while waiting:
        one = waiting.pop()
        if isinstance(one, tuple):
            waiting += one
        elif isinstance(one, msgspec.Struct):
            if isinstance(one, Call):
                found.append(one)
            waiting += [getattr(one, name) for name in one.__struct_fields__]
    yield from sorted(found, key=lambda one: (one.line, one.column))
