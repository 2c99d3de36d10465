"""Types that choose an overload: ``advertise(topic, std::is_same<Message, Image>{})``."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from roslens.source.extract.domain.abstract_value import Unknown, Value
from roslens.source.extract.interpreter.vocabulary import CallSite, outer

if TYPE_CHECKING:
    from roslens.source.extract.transfer.context import Context

_WHOLE = re.compile(r"[A-Za-z_]\w*(::[A-Za-z_]\w*)+")
_BUILT_IN = frozenset({"bool", "char", "double", "float", "int", "long", "short", "unsigned", "void"})


@outer("std.true_type", "std.false_type", quiet=True)
def tag(_ctx: Context, _thing: Value, called: CallSite) -> Value:
    """The name of a tag."""
    return called.name == "std.true_type"


@outer("std.is_same", "boost.is_same", quiet=True)
def same(_ctx: Context, _thing: Value, called: CallSite) -> Value:
    """Whether two types are one, as far as both are known by their whole names."""
    if len(called.templates) != 2:
        return Unknown("whether types are the same")
    one, other = (each.replace(" ", "").removeprefix("::") for each in called.templates)
    if one == other:
        return True
    known = all(each in _BUILT_IN or _WHOLE.fullmatch(each) for each in (one, other))
    return False if known else Unknown(f"whether {one} is {other}")
