"""Which parts of a system are worth a row where a person looks: not what every node of ROS has, unless it is judged."""

from __future__ import annotations

from roslens.live.system.tree import SystemView
from roslens.model.verdict import State

_TOPICS = frozenset({"/rosout", "/rosout_agg", "/parameter_events", "/statistics"})
_WRONG = tuple(state.value for state in reversed(State) if state.bad or state is State.UNKNOWN)
_TO_NOBODY = " > ?"
_ENDS = frozenset(
    {"get_parameters", "set_parameters", "set_parameters_atomically", "list_parameters", "describe_parameters",
     "get_parameter_types", "get_type_description", "get_loggers", "set_logger_level", "get_logger_levels",
     "set_logger_levels", "transition_event", "get_state", "change_state", "get_available_states",
     "get_available_transitions", "get_transition_graph"}
)  # fmt: skip


def not_judged(whole: SystemView) -> int:
    """Return how many parts that are worth a row nothing judges, each once."""
    found = set()
    waiting = list(whole.children)
    while waiting:
        part = waiting.pop()
        if is_shown(part):
            if part.state is None and part.name:
                found.add(part.id)
            waiting += part.children
    return len(found)


def badge(part: SystemView) -> str:
    """Return what is wrong or unknown below a part: ``1 absent, 2 unknown below``; empty where nothing is."""
    if not part.below:
        return ""
    counts = [f"{part.below[state]} {state}" for state in _WRONG if part.below.get(state)]
    return f"{', '.join(counts)} below" if counts else ""


def is_shown(part: SystemView) -> bool:
    """Return whether to show a part: something is expected of it, or it is not like what all others have too.

    What a process uses is reported of its nodes; alone it is worth a row where a constraint is about it. Likewise with
    the log, the parameters and the life cycle of nodes, which ROS itself serves, and with what was sent to nobody in
    particular: the topic above tells it.
    """
    if part.counts:
        return True
    if part.kind == "process" or (part.kind == "connection" and part.name.endswith(_TO_NOBODY)):
        return False
    if part.kind == "topic" and part.name in _TOPICS:
        return False
    return part.kind not in ("topic", "service") or part.name.rpartition("/")[2] not in _ENDS
