"""Nodelets that a program loads into its own process, as if a launch file loaded them."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

import msgspec

from roslens.model.configuration import ConfiguredNode, ConfiguredRemap, Proof
from roslens.source.extract.configuration.assemble_node import Given, place_of, values_of
from roslens.source.extract.facts.launched import Launched, Remap
from roslens.source.extract.facts.node_facts import NodeFacts
from roslens.source.extract.facts.resolve_name import TOP, expand
from roslens.source.extract.symbolic.text import Hole, Text


def loaded_by(given: Given, facts: NodeFacts) -> Iterator[Launched]:
    """Yield what is loaded into the process of a node.

    A remapping of the process holds for its nodelets too, where they have none of their own (roscpp,
    ``NodeHandle::remapName``).
    """
    place, values, of_process = place_of(given, facts), values_of(given, facts), given.launched
    line = tuple(Remap(one.source, one.target, one.evidence) for one in given.line.rules if not one.special)
    for load in facts.loads:
        whole = expand(values.fill(load.name).text, place)
        same = whole == place.node
        namespace, name = (of_process.namespace, of_process.name) if same else _split(whole)
        own = tuple(
            Remap(values.fill(source).text, values.fill(target).text, load.evidence) for source, target in load.remaps
        )
        yield Launched(
            package=of_process.package,
            executable=Text(),
            evidence=of_process.evidence if given.by_launch else load.evidence,
            name=name if not same or name.parts else _split(whole)[1],
            namespace=namespace,
            plugin=values.fill(load.type).text,
            container=place.node,
            settings=of_process.settings if same else (),
            remaps=(*line, *of_process.remaps, *own),
            conditions=(*of_process.conditions, *dict.fromkeys((*facts.conditions, *load.conditions))),
            kind="nodelet",
            machine=of_process.machine,
            anonymous=of_process.anonymous,
        )


def _split(whole: Text) -> tuple[Text, Text]:
    """Return the namespace and the last part of a resolved name."""
    for place in range(len(whole.parts) - 1, -1, -1):
        part = whole.parts[place]
        if isinstance(part, str) and "/" in part:
            before, _, after = part.rpartition("/")
            space = Text.of(*whole.parts[:place], before)
            return space if space.parts else TOP, Text.of(after, *whole.parts[place + 1 :])
    return Text((Hole("namespace of a name that is unknown"),)), whole


def with_used(node: ConfiguredNode, nodelets: Iterable[ConfiguredNode]) -> ConfiguredNode:
    """Return the node of a process whose remappings count as used where one of its nodelets uses them."""
    found: Sequence[ConfiguredNode] = list(nodelets)
    used = {_key(one) for nodelet in found for one in nodelet.remaps if one.used}
    uncertain = {_key(one) for nodelet in found for one in nodelet.remaps if one.uncertain}
    remaps = tuple(
        msgspec.structs.replace(one, used=True, uncertain=False)
        if _key(one) in used
        else msgspec.structs.replace(one, uncertain=not one.used and (one.uncertain or _key(one) in uncertain))
        for one in node.remaps
    )
    return msgspec.structs.replace(node, remaps=remaps)


def _key(one: ConfiguredRemap) -> tuple[str, str, Proof]:
    return one.source, one.target, one.proof
