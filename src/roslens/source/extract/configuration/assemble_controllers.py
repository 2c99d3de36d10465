"""Controllers of ROS 1 that a launch file spawns, in the node whose code has their manager.

What a controller makes is known of the catalogue, or by the class of the workspace that its parameter ``type`` names,
wherever that is set: most launch files load it below no node. The names in it begin with that of the controller.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import msgspec

from roslens.source.extract.configuration.assemble_node import Given, place_of
from roslens.source.extract.configuration.assemble_units import Units
from roslens.source.extract.facts.launched import Controller
from roslens.source.extract.facts.node_facts import EndpointFact, NodeFacts, Sure
from roslens.source.extract.facts.resolve_name import absolute, expand
from roslens.source.extract.symbolic.reason import OfController
from roslens.source.extract.symbolic.text import Hole, Text

_LOADS = Text.of("controller_manager/load_controller")


def controllers_in(
    given: Given, facts: NodeFacts, controllers: Sequence[Controller], units: Units
) -> Iterator[tuple[Controller, tuple[EndpointFact, ...]]]:
    """Yield the controllers that the manager in a node loads, each with what it makes.

    Args:
        given: what starts the node.
        facts: of it.
        controllers: that are spawned, and of which the node is not known yet.
        units: of the workspace.
    """
    if not controllers:
        return
    place = place_of(given, facts)
    known = {expand(one.name, place).pattern for one in (*facts.endpoints, *given.launched.plugged)}
    for one in controllers:
        if absolute(one.space, _LOADS).pattern in known and (made := one.made or tuple(_of_class(one, units))):
            yield one, made


def _of_class(controller: Controller, units: Units) -> Iterator[EndpointFact]:
    why = f"controller {controller.kind}, which is spawned at {controller.evidence.path}:{controller.evidence.line}"
    for part in units.parts(controller.kind):
        for one in part.endpoints if part.generation == "ros1" else ():
            # The namespace, which code alone does not know, is known here.
            reasons = {type(hole.reason) for hole in one.name.holes}
            known = one.evidence.sure is Sure.CERTAIN or reasons == {OfController}
            sure = Sure.LIKELY if known else one.evidence.sure
            evidence = msgspec.structs.replace(one.evidence, how=why, sure=sure)
            conditions = (*controller.conditions, *one.conditions)
            name = _named(one.name, controller.name)
            yield msgspec.structs.replace(one, name=name, evidence=evidence, conditions=conditions)


def _named(name: Text, controller: Text) -> Text:
    def own(part: str | Hole) -> bool:
        match part:
            case Hole(reason=OfController()):
                return True
        return False

    return Text.of(*(controller if own(one) else one for one in name.parts))
