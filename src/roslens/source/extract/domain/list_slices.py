"""Parts of lists and texts of Python: ``words[1:]``, ``name[:-1]``."""

from __future__ import annotations

import re

from roslens.source.extract.domain.abstract_value import Unknown, Value
from roslens.source.extract.domain.guarded import is_counted
from roslens.source.extract.domain.word_list import Words
from roslens.source.extract.symbolic.text import Text, said, unknown

_SLICE = re.compile(r"(-?\d*)\s*:\s*(-?\d*)")
_ANY = re.compile(r"[^\[\](){}\"']*:[^\[\](){}\"']*")


def is_slice(written: str) -> bool:
    """Whether what stands between brackets is a slice."""
    return _ANY.fullmatch(written) is not None


def part_of(value: Value, written: str) -> Value:
    """Return a part of a list or text; what is unknown of it is a hole, or unknown."""
    found = _SLICE.fullmatch(written.strip())
    ends = None if found is None else [int(one) if one not in ("", "-") else None for one in found.groups()]
    if ends is not None and isinstance(value, Words):
        part = value.part(*ends)
        return part if part is not None else Unknown(f"words [{written}]")
    if ends is not None and isinstance(value, list) and (is_counted(value) or ends == [None, None]):
        return value[ends[0] : ends[1]]
    if isinstance(value, Text):
        if ends is not None and value.known is not None:
            return Text.of(value.known[ends[0] : ends[1]])
        return unknown(said("a part of ", value), parameter=next((hole.parameter for hole in value.holes), ""))
    return value if isinstance(value, Unknown) else Unknown(f"a part of what is not known [{written}]")
