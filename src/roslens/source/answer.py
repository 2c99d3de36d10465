"""What an analysis answers with."""

from __future__ import annotations

import msgspec


class Answer(msgspec.Struct, frozen=True):
    """Which run answers the question, whether it had to be made, and how many packages were measured for it.

    ``left_out`` is how many sources of these packages were not looked at, because they are unchanged.
    """

    run: int
    fresh: bool
    measured: int
    packages: int
    left_out: int = 0
