"""Estimated number of static paths."""

from __future__ import annotations

from collections.abc import Sequence

from roslens.model.entity import EntityKind
from roslens.model.quantity import Fold, Quantity
from roslens.source.metrics.complexity.countable import countable_control
from roslens.source.settings import CountingSettings
from roslens.source.syntax.facts import Control, FunctionFacts

MOST = 10**9
"""Larger numbers are cut off here: a billion paths are never tested."""

QUANTITY = Quantity(
    key="static_paths",
    title="Static paths",
    unit="paths",
    kinds=(EntityKind.FUNCTION,),
    text="How many paths lead through a function if all conditions are independent: an upper bound of the tests "
    "that cover all paths.",
    folds=(Fold.MEAN, Fold.MAX),
    formula="a sequence multiplies; if: paths of its arms added up, + 1 without else; for, while, do: paths of the "
    "body + 1 (with `else`: + paths of that); switch / match: paths of its distinct arms added up, + 1 without "
    "default; try: paths of the body (times those of else) + those of each catch, all times those of finally; ?: 2 + "
    "what its arms have above 1; everything else 1",
    source="STPTH of the ROS, KTH and HIS models (QA-C), after Nejmeh, NPATH, CACM 31(2), 1988, without his count of "
    "logical operators",
    limits="Cut off at 1,000,000,000. return, break, goto and falling through do not shorten a path. Conditions that "
    "exclude each other are not detected. Case labels of C and C++ with no control between them share an arm; labels "
    "inside a loop inside the switch (Duff's device) are none of its arms. Both arms of `#if` count as one after the "
    "other unless `counting.alternatives` is off, a lambda as if it ran at its place unless `counting.lambdas` is "
    "off.",
    minimum=1,
    maximum=MOST,
    decimals=0,
)

_BRANCHES = frozenset({"if", "for", "while", "do", "switch", "try", "ternary"})
_LABELS = frozenset({"case", "default"})
_ARMS = frozenset({"elif", "else", "loop_else", "catch", "try_else", "finally"})


def of_function(facts: FunctionFacts, counting: CountingSettings) -> float:
    """Return the number of static paths of a function of C or C++."""
    if _BRANCHES.isdisjoint(facts.counts):
        return 1
    return _of_control(countable_control(facts, counting), shared_arms=True)


def of_python_function(facts: FunctionFacts, counting: CountingSettings) -> float:
    """Return the number of static paths of a function of Python, where every ``case`` is an arm of its own."""
    if _BRANCHES.isdisjoint(facts.counts):
        return 1
    return _of_control(countable_control(facts, counting), shared_arms=False)


class _Level:
    """What is known of the events of one depth below one parent, read from the last one back."""

    __slots__ = ("body", "condition", "default", "empty", "excess", "last_arm", "more_arms", "paths_of_labels", "times")

    def __init__(self) -> None:
        self.empty = True
        self.body = 1
        self.condition = 1
        # The sum, over the structures in the body, of their paths above the first.
        self.excess = 0
        # Arms read before the if, loop or try that they belong to.
        self.more_arms = 0
        self.last_arm = 0
        self.times = 1
        # Arms of the switch whose body this level is.
        self.paths_of_labels = 0
        self.default = False


_NOTHING = _Level()


def _of_control(control: Sequence[Control], *, shared_arms: bool) -> int:
    # Read backwards, all that belongs to an event is known when the event comes.
    levels = [_Level()]
    for event in reversed(control):
        role, depth = event.role, event.depth
        above = len(levels) - 1 - depth
        if above < 1:
            levels.extend([_Level() for _ in range(-above)])
            below = _NOTHING
        else:
            below = levels[depth + 1]
            del levels[depth + 1 :]
        level = levels[depth]
        level.empty = False
        if role in _BRANCHES:
            _multiply(level, event.part, _of_structure(role, level, below))
        elif role in _LABELS:
            _add_label(role, level, below, shared_arms=shared_arms)
        elif role in _ARMS:
            _add_arm(role, level, below)
        elif below is not _NOTHING:
            _multiply(level, event.part, below.body * below.condition)
    return min(MOST, levels[0].body * levels[0].condition)


def _multiply(level: _Level, part: str, paths: int) -> None:
    if part == "body":
        level.body = min(MOST, level.body * paths)
        level.excess = min(MOST, level.excess + paths - 1)
    else:
        level.condition = min(MOST, level.condition * paths)


def _add_arm(role: str, level: _Level, below: _Level) -> None:
    if role in ("elif", "catch"):
        level.more_arms += below.body
        level.times = min(MOST, level.times * below.condition)
    elif role == "finally":
        level.times = min(MOST, level.times * below.body)
    else:
        level.last_arm = below.body


def _add_label(role: str, level: _Level, below: _Level, *, shared_arms: bool) -> None:
    nothing_after = not level.paths_of_labels
    if not (shared_arms and below.empty) or nothing_after:
        level.paths_of_labels += below.body * below.condition
    level.default = level.default or role == "default"


def _of_structure(role: str, level: _Level, below: _Level) -> int:
    if role == "ternary":
        return (2 + below.excess) * below.condition
    if role == "switch":
        return (below.paths_of_labels + (not below.default)) * below.body * below.condition
    last, own = level.last_arm, below.body
    paths = own * (last or 1) if role == "try" else own + (last or 1)
    paths = (paths + level.more_arms) * level.times * below.condition
    level.more_arms, level.last_arm, level.times = 0, 0, 1
    return paths
