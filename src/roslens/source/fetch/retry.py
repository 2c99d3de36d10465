"""Trying again what a network broke, after growing pauses; what will not change is not tried again."""

from __future__ import annotations

import re
from collections.abc import Callable

import msgspec

PAUSES_S = (2.0, 8.0, 30.0)
"""Between tries: a server that limits rates asks for no more than this as a rule."""

_FINAL = re.compile(
    r"not found|does not exist|does not appear to be a git repository|couldn't find remote ref|no such (?:remote|ref)"
    r"|authentication failed|could not read (?:username|password)|permission denied|access denied|not our ref"
    r"|host key verification failed"
    r"|returned error: 40[134]|not allowed|certificate|no space left|cannot be started|repository corruption",
    re.IGNORECASE,
)


class Retry(msgspec.Struct, frozen=True):
    """How often and after which pauses something is tried again.

    Attributes:
        sleep: waits so many seconds.
        pauses_s: seconds before the second, the third… try.
        end: ends all waits, now and from now on.
    """

    sleep: Callable[[float], object]
    pauses_s: tuple[float, ...] = PAUSES_S
    end: Callable[[], object] = bool


def may_pass(complaint: str) -> bool:
    """Return whether what git or a server complained about may be gone at the next try."""
    return _FINAL.search(complaint) is None
