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
    match value:
        case Words() if ends is not None:
            part = value.part(*ends)
            return part if part is not None else Unknown(f"words [{written}]")
        case list() if ends is not None and (is_counted(value) or ends == [None, None]):
            return value[ends[0] : ends[1]]
        case Text(known=str(known)) if ends is not None:
            return Text.of(known[ends[0] : ends[1]])
        case Text():
            return unknown(said("a part of ", value), parameter=next((hole.parameter for hole in value.holes), ""))
        case Unknown():
            return value
    return Unknown(f"a slice of an unknown value [{written}]")
