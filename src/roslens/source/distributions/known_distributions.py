"""The distributions of ROS, in order."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache
from pathlib import Path

import msgspec


class Distribution(msgspec.Struct, frozen=True):
    """One distribution.

    Attributes:
        name: in lower case, as ``$ROS_DISTRO`` has it.
        ros: 1 or 2.
        rank: its place in the order of releases; Rolling is the last one.
        released: year and month; empty for Rolling.
        end: year and month from which it is not supported any more; empty where there is none.
    """

    name: str
    ros: int
    rank: int
    released: str
    end: str

    @property
    def title(self) -> str:
        """Its name as people write it."""
        return self.name.capitalize()


OLDEST_SUPPORTED = {1: "noetic", 2: "humble"}
"""What a workspace is taken to be for at least where nothing says it, by the version of ROS."""


@cache
def distributions() -> Mapping[str, Distribution]:
    """Return all distributions by name, in the order of their release."""
    import tomli

    rows = tomli.loads(Path(__file__).with_name("distributions.toml").read_text("utf-8"))
    return {name: Distribution(name, rank=rank, **row) for rank, (name, row) in enumerate(rows.items())}


def is_at_least(name: str, other: str) -> bool:
    """Return whether a distribution is another one or came after it, both being of one version of ROS."""
    one, two = distributions()[name], distributions()[other]
    return one.ros == two.ros and one.rank >= two.rank
