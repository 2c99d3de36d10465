"""What the platform refuses: a place in a file, what stands there, and what is expected."""

from __future__ import annotations

import msgspec


class Refusal(msgspec.Struct, frozen=True, array_like=True, omit_defaults=True):
    """Why ROS does not take a file.

    Attributes:
        line: 1-based.
        column: in characters, 1-based.
        what: was found, quoted.
        expected: instead.
        taken_elsewhere: whether another reader of such files takes it, as PyYAML takes what rcl refuses.
    """

    line: int
    column: int
    what: str
    expected: str
    taken_elsewhere: bool = False
