"""What a launch file of ROS 1 sets under a condition that only the machine decides, as ``if="$(optenv SIM 0)"``."""

from __future__ import annotations

import msgspec

from roslens.source.extract.facts.launched import Setting
from roslens.source.extract.symbolic.text import Condition, Text, unknown


class Doubt(msgspec.Struct, frozen=True):
    """A condition that cannot be decided, and what it comes to where the machine says nothing; None where unknown."""

    condition: Condition
    usual: bool | None = None


def only_if(doubts: tuple[Doubt, ...], found: Text, before: Text | None = None) -> Text:
    """Return a text that stands there only under conditions, in place of what stood there before."""
    if not doubts or found == before:
        return found
    usually = {one.usual for one in doubts}
    if False in usually:
        default = None if before is None else before.usual
    else:
        default = None if None in usually else found.usual
    return unknown(f"{found}, if {' and '.join(str(one.condition) for one in doubts)}", default=default)


def setting_if(doubts: tuple[Doubt, ...], setting: Setting) -> Setting:
    """Return a parameter that is set only under conditions: whether it is, and so its value, is unknown."""
    return msgspec.structs.replace(setting, value=only_if(doubts, setting.value)) if doubts else setting
