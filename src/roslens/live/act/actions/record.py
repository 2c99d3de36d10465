"""``record``: what was just said on some topics, and what is said next."""

from __future__ import annotations

from roslens.live.act.ros import ActionError, Asked, Ros

_LONGEST_S = 120.0


def prepare(ros: Ros, asked: Asked) -> None:
    """Begin to keep what is said.

    Raises:
        ActionError: the times make no sense, or a pattern is none.
    """
    before_s, after_s = _times(asked)
    ros.record(tuple(asked.arguments["topics"]), before_s, "", after_s)


def act(ros: Ros, asked: Asked) -> str:
    """Write the recording, and return a description of its content.

    Raises:
        ActionError: it cannot be written.
    """
    before_s, after_s = _times(asked)
    return ros.record(tuple(asked.arguments["topics"]), before_s, str(asked.arguments["path"]), after_s)


def _times(asked: Asked) -> tuple[float, float]:
    before_s, after_s = float(asked.arguments["before"]), float(asked.arguments["after"])
    if not (0 <= before_s <= _LONGEST_S and 0 <= after_s <= _LONGEST_S):
        raise ActionError(f"{before_s:g} s before and {after_s:g} s after", expected=f"up to {_LONGEST_S:g} s each")
    return before_s, after_s
