"""Where an evaluation stands: the function that is followed, the path condition, and what variables hold."""

from __future__ import annotations

from roslens.source.extract.domain.abstract_value import Names, Value
from roslens.source.extract.domain.frame import Frame
from roslens.source.extract.domain.store import Store
from roslens.source.extract.facts.node_facts import Evidence
from roslens.source.extract.ir.program import Call, Expression
from roslens.source.extract.symbolic.text import Condition


class State:
    """What changes from one statement to the next.

    Attributes:
        frame: of the function that is evaluated.
        conditions: the path condition: those around what is evaluated, outermost first.
        asked: what decides conditions, by their place, with the condition that stood there.
        store: what is changed in objects while ways of open conditions are followed.
        globals: variables of C++ outside of functions that were set, by their whole names.
        constants: values outside of functions that were asked for, by file and name.
        once: values of variables that functions keep between calls, by their place.
        gave: where the value stands to which the last call returned a reference, in its frame.
        preparing: classes whose objects are given their members, the outermost first.
        site: of the last call.
        written: its arguments as expressions.
    """

    __slots__ = (
        "_frames",
        "asked",
        "conditions",
        "constants",
        "frame",
        "gave",
        "globals",
        "once",
        "preparing",
        "site",
        "store",
        "written",
    )

    def __init__(self, frame: Frame, site: Evidence, store: Store | None = None) -> None:
        """Begin in a frame, as which those of all calls are made."""
        self._frames = type(frame)
        self.frame = frame
        self.site = site
        self.written: tuple[Expression, ...] = ()
        self.conditions: list[Condition] = []
        self.asked: dict[int, tuple[Condition, Condition | None]] = {}
        self.store = store or Store()
        self.globals: Names = {}
        self.constants: dict[tuple[str, str], Value] = {}
        self.once: dict[tuple[object, ...], Value] = {}
        self.gave: tuple[Frame, Expression] | None = None
        self.preparing: list[str] = []

    def at(self, call: Call) -> None:
        """Note which call is made next."""
        self.site = Evidence(self.frame.path, call.line, call.column)
        self.written = call.arguments

    def written_at(self, line: int) -> None:
        """Note the line at which something is made next that no call makes."""
        if line:
            self.site = Evidence(self.frame.path, line)

    def frame_of(self, path: str, scope: str, thing: Value = None, names: Names | None = None) -> Frame:
        """Return the frame of a call that begins."""
        return self._frames(path, scope, thing, names)

    def under(self, condition: Condition, test: Condition | None = None) -> None:
        """Let a condition hold for what follows, until it is taken away again."""
        self.asked[len(self.conditions)] = (condition, test)
        self.conditions.append(condition)

    def asked_now(self) -> tuple[tuple[Condition, Condition], ...]:
        """Return those of the conditions that parameters decide."""
        found = (self.asked.get(place, (None, None)) for place in range(len(self.conditions)))
        pairs = zip(self.conditions, found, strict=True)
        return tuple(dict.fromkeys((one, test) for one, (known, test) in pairs if one == known and test is not None))
