"""A launch file in Python, evaluated by the interpreter that follows nodes, over what launch and launch_ros mean.

Calls that are not known here are unknown values. Both ways of an open condition are followed, and what is made there
keeps the condition. Of two values that a condition chooses neither is taken for the other, as the interpreter does with
objects of nodes: :class:`~roslens.source.extract.launch_python.launch_values.Either` has both.
"""

from __future__ import annotations

from functools import partial

from roslens.source.extract.domain.abstract_value import Callable, Invocation, Names, NodeBuilder, Value
from roslens.source.extract.domain.state import State
from roslens.source.extract.facts.files import Files
from roslens.source.extract.facts.node_facts import Evidence
from roslens.source.extract.interpreter.interpreter import Interpreter, Parts
from roslens.source.extract.interpreter.vocabulary_index import indexed
from roslens.source.extract.launch_python.deferred import Scope
from roslens.source.extract.launch_python.launch_calls import LaunchCalls
from roslens.source.extract.launch_python.launch_expressions import LaunchExpressions
from roslens.source.extract.launch_python.launch_sources import AsWritten, programs_of
from roslens.source.extract.launch_python.launch_ways import LaunchFrame, LaunchStore
from roslens.source.extract.launch_python.visit import Visit
from roslens.source.extract.transfer.budget import Budget

MOST_STEPS = 300_000
MOST_FRAMES = 25
MOST_TURNS = 1_000


class LaunchProgram:
    """An evaluation of a launch file."""

    def __init__(self, path: str, content: bytes, files: Files | None = None) -> None:
        """Read the file, and what it imports of the workspace."""
        programs, places = programs_of(path, content, files)
        # What a launch file imports it sees, whichever package has it.
        index = indexed(programs, dict.fromkeys(programs, "launch"))
        index.memo = AsWritten(places)
        self._path = path
        self._visit = visit = Visit(path, files)
        self._interpreter = Interpreter(
            index,
            NodeBuilder("<launch>", path, 1, "ros2", parameters=[], endpoints=[], unresolved=[]),
            parts=Parts(partial(LaunchExpressions, visit=visit), partial(LaunchCalls, visit=visit)),
            state=State(LaunchFrame(path, ""), Evidence(path, 1), LaunchStore()),
            budget=Budget(MOST_STEPS, MOST_FRAMES, MOST_TURNS, MOST_TURNS),
        )

    @property
    def state(self) -> State:
        """Where the evaluation stands."""
        return self._interpreter.state

    def entry(self, name: str) -> Callable | None:
        """Return a function of the file."""
        return self._interpreter.named.function(name, 0)

    def run(self, function: Callable, arguments: list[Value], keywords: Names, scope: Scope | None = None) -> Value:
        """Call a function; what it returns may be unknown.

        Raises:
            BudgetExceededError: the bounds are spent.
        """
        outer = self._visit.scope, self._visit.reporting
        if scope is not None:
            self._visit.scope, self._visit.reporting = scope.silent(), scope
        try:
            return self._interpreter.call(Invocation(function, arguments, keywords))
        finally:
            self._visit.scope, self._visit.reporting = outer
            self.state.frame = LaunchFrame(self._path, "")
            self.state.conditions.clear()
