"""Whether the actions of some reactions that are carried out through ROS can be done, as far as reported."""

from __future__ import annotations

from collections.abc import Sequence

from roslens.live.react.ros_line import RosLine
from roslens.model.acting.action_kind import ActionKind, By, action_kind
from roslens.model.acting.order import Reply
from roslens.model.acting.reaction import ActionCall, Decision, Reaction

NO_ROS = "no ROS that has it is observed. Start it in a shell where ROS is set up, or give --ros1 or --ros2 --python"
_SILENT = "not answered yet"


class Prepared:
    """The actions of one reading of a reference. ``turn`` distinguishes the ids of different readings."""

    def __init__(self, turn: int = 0) -> None:
        """Begin with no action."""
        self._turn = f"@{turn}" if turn else ""
        self._places: dict[str, str] = {}
        self._unfit: dict[tuple[int, str], str] = {}

    def ask(self, lines: Sequence[RosLine], reactions: Sequence[Reaction]) -> None:
        """Have every line get ready for what it may have to do."""
        for reaction in reactions:
            for number, step in enumerate(reaction.steps):
                kind = action_kind(step.action.kind)
                if kind is not None and kind.by is By.ROS:
                    self._ask_for(lines, self._id(reaction.name, number), step.action, kind)

    def _ask_for(self, lines: Sequence[RosLine], id_: str, call: ActionCall, kind: ActionKind) -> None:
        self._places[id_] = call.place
        target = call.target.name if call.target is not None else ""
        for line in lines:
            if line.generation in kind.ros:
                self._unfit[line.generation, id_] = _SILENT
                line.prepare(id_, call.kind, target, kind.filled(call.arguments))

    def take(self, generation: int, reply: Reply) -> None:
        """Take the report of a line on an action; those of another reading are ignored."""
        if (generation, reply.id) in self._unfit:
            self._unfit[generation, reply.id] = "" if reply.done else reply.text

    def fit(self, generation: int, decision: Decision) -> bool:
        """Return whether a line can do what was decided, as far as that is known."""
        return not self._unfit.get((generation, self._id(decision.reaction, decision.step)), "")

    def unready(self) -> dict[str, str]:
        """Return what cannot be done in any ROS that is observed, and why, by its place in the document."""
        found = {}
        for id_, place in self._places.items():
            reasons = [why for (_, one), why in self._unfit.items() if one == id_]
            if all(reasons):
                found[place or id_] = reasons[0] if reasons else NO_ROS
        return found

    def waiting(self) -> bool:
        """Whether some executor has not reported yet whether all can be done."""
        return _SILENT in self._unfit.values()

    def forget(self, lines: Sequence[RosLine]) -> None:
        """Have no line get ready for this again."""
        for line in lines:
            for id_ in self._places:
                line.forget(id_)

    def _id(self, reaction: str, number: int) -> str:
        return f"{reaction}/prepare.{number + 1}{self._turn}"
