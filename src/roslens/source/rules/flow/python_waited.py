"""What brings a callback the thing that it waits for: the client of a future, the callbacks that set a value."""

from __future__ import annotations

from collections.abc import Iterable

from tree_sitter import Node

from roslens.source.rules.callbacks import callee_name
from roslens.source.rules.calls import receiver
from roslens.source.rules.file_view import FileView
from roslens.source.rules.flow.python_callbacks import ways_to
from roslens.source.rules.flow.python_functions import python_functions
from roslens.source.rules.flow.python_threads import Blocked, blocked, made_by
from roslens.source.rules.flow.summary import CallbackKind, Registration, Way

ASYNC = frozenset({"call_async", "send_goal_async", "get_result_async", "cancel_goal_async"})
"""Methods of clients that return a future."""
_CLIENTS = frozenset({"create_client", "ActionClient"})


def client_of(sent: Node, view: FileView) -> Node | None:
    """Return the call that makes the client whose request a call sends; of goals, that of the only action client."""
    of = receiver(sent)
    client = made_by(of, _CLIENTS, view) if of is not None else None
    if client is not None or callee_name(sent, view) in ("call_async", "send_goal_async"):
        return client
    made = [one for one in python_functions(view).calls if callee_name(one, view) == "ActionClient"]
    return made[0] if len(made) == 1 else None


def brought_by_callbacks(way: Way, places: Iterable[Node], view: FileView) -> Blocked | None:
    """Return why none of some places can run while a callback waits; None where one may, or nobody knows what runs it.

    Args:
        way: to the code that waits.
        places: where what is waited for is set.
        view: of the file.
    """
    whys: list[Blocked] = []
    waiting = way.registration
    for place in places:
        known = ways_to(place, view)
        if not known:
            return None
        for one in known:
            if one.registration.target.function == waiting.target.function:
                continue
            why = _keeps_back(waiting, one.registration, view)
            if why is None:
                return None
            whys.append(why)
    return whys[0] if whys else None


def _keeps_back(waiting: Registration, setting: Registration, view: FileView) -> Blocked | None:
    if setting.kind is not CallbackKind.DONE:
        return blocked(waiting, setting.call, view)
    future = receiver(setting.call)
    sent = made_by(future, ASYNC, view) if future is not None else None
    client = client_of(sent, view) if sent is not None else None
    return blocked(waiting, client, view) if client is not None else None
