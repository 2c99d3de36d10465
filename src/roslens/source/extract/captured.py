"""Variables of the function around that a lambda of C++ sets: ``[&]() { topic = "b"; }``."""

from __future__ import annotations

from typing import TYPE_CHECKING

from roslens.source.extract.abstract_value import Callable, QosValue, Unknown
from roslens.source.extract.evaluation_frame import Frame
from roslens.source.extract.text import Text, unknown
from roslens.source.extract.workspace_index import assigned_names

if TYPE_CHECKING:
    from roslens.source.extract.evaluation import Evaluation


def set_around(engine: Evaluation, function: Callable, frame: Frame) -> None:
    """Forget what variables around a lambda were that it set when it was called.

    Whether a name is that of a variable around, or of one of its own (``auto topic = "b"``), a program does not tell:
    so nobody knows what the one around is, rather than that it has a value that it may not have.
    """
    around, what = function.names, function.function
    if not around or engine.index.programs[function.path].language != "cpp":
        return
    own = {parameter.name for parameter in what.parameters}
    here = engine.frame if engine.frame.scope == what.qualified_name.rpartition(".")[0] else None
    for name in assigned_names(what.body) - own:
        before, after = around.get(name), frame.names.get(name)
        if before is None or after is before or after == before:
            continue
        lost: Text | Unknown | None = None
        if isinstance(before, Text):
            lost = unknown(f"{name}, which a lambda sets")
        elif isinstance(before, Unknown | bool | int | float | QosValue):
            lost = Unknown(f"{name}, which a lambda sets")
        for names in (around, here.names if here is not None else around) if lost is not None else ():
            if name in names:
                names[name] = lost
