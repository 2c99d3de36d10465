"""What holds for the actions of a launch file of ROS 2, besides launch configurations."""

from __future__ import annotations

import msgspec

from roslens.source.extract.facts.launched import Remap, Setting
from roslens.source.extract.launch_python.deferred import Scope, resolve
from roslens.source.extract.launch_python.launch_action import Action
from roslens.source.extract.symbolic.text import Conditions, Text


class Space(msgspec.Struct):
    """What holds for the actions that follow, besides launch configurations."""

    namespace: Text = Text(("/",))
    settings: tuple[Setting, ...] = ()
    remaps: tuple[Remap, ...] = ()
    conditions: Conditions = ()


def keep(inner: Space, space: Space) -> None:
    """Let what was set within hold after it."""
    space.namespace, space.settings, space.remaps = inner.namespace, inner.settings, inner.remaps


def remaps_of(action: Action, scope: Scope) -> list[Remap]:
    """Return the remappings of an action."""
    return [Remap(resolve(source, scope), resolve(target, scope), action.evidence) for source, target in action.remaps]
