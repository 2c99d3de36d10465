"""Flags and counters of a C++ file that functions set of which not all is lowered: their values are unknown.

``static int map_loaded = 0;`` decides what a callback does, and another function sets it while it only computes: taken
for a constant it would hide all that stands behind ``if (map_loaded == 1)``.
"""

from __future__ import annotations

import re
from collections.abc import Sequence

import msgspec

from roslens.source.extract.ir.program import Assign, Literal, Name, Opaque, Statement

# It begins where a word does: from within a long one, each place would be tried to its end.
_SET = re.compile(rb"(?<!\w)(\w+)\s*(?:[-+*/|&^%]?=(?!=)|\+\+|--)")
_NUMBERS = (int, bool, float)
_COUNTED = re.compile(rb"(?:\+\+|--)\s*(\w+)")


def unsettled(body: list[Statement], source: bytes, left_out: Sequence[int]) -> list[Statement]:
    """Return what stands outside of functions, without the first values of numbers that are set in parts left out.

    Args:
        body: statements outside of functions.
        source: of the file.
        left_out: where the bodies of functions begin and end that are not lowered as a whole, in turn.
    """
    flags = {
        one.target.name.rpartition(".")[2].encode(): place
        for place, one in enumerate(body)
        if type(one) is Assign and type(one.value) is Literal and type(one.value.value) in _NUMBERS
        if type(one.target) is Name
    }
    if not flags:
        return body
    found: set[bytes] = set()
    for start, end in zip(left_out[::2], left_out[1::2], strict=True):
        found.update(_SET.findall(source, start, end), _COUNTED.findall(source, start, end))
    settled = list(body)
    for name in flags.keys() & found:
        one = body[flags[name]]
        if isinstance(one, Assign):
            settled[flags[name]] = msgspec.structs.replace(one, value=Opaque(f"the value of {name.decode()}"))
    return settled
