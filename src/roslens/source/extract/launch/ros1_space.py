"""What holds at a place of a launch file of ROS 1, and what the file is given."""

from __future__ import annotations

import msgspec

from roslens.source.extract.facts.launched import Setting
from roslens.source.extract.launch.ros1_doubt import Doubt
from roslens.source.extract.symbolic.text import Conditions, Text


class Space(msgspec.Struct, frozen=True):
    """What holds at a place of a file: the namespace, remappings and conditions around it."""

    namespace: Text
    conditions: Conditions = ()
    private: tuple[Setting, ...] = ()
    """Parameters with ``~`` outside of nodes, which later nodes get."""
    around: tuple[Doubt, ...] = ()
    """The conditions, with what they usually come to."""
    own: tuple[Doubt, ...] = ()
    """Those of the element itself."""


class Given(msgspec.Struct, frozen=True):
    """Arguments of a file; whether they are of the command line, or all of who includes it."""

    arguments: dict[str, Text]
    outer: bool = False
    every: bool = False
