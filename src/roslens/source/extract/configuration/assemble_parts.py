"""Code that is in a node though no code was seen to load it: a hint or a parameter of a launch file names it.

A parameter names a plug-in where a word of its value is the name by which a description has it: ``pkg/Class``. What a
plug-in makes then is likely: whoever loads it was not read.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping

import msgspec

from roslens.source.extract.catalogue.hints import hint_of
from roslens.source.extract.configuration.assemble_node import Given, place_of, values_of
from roslens.source.extract.configuration.assemble_units import Units
from roslens.source.extract.facts.node_facts import EndpointFact, NodeFacts, Sure
from roslens.source.extract.symbols.call_sites import places_of
from roslens.source.settings import NodeHint

_WORD = re.compile(r"[A-Za-z]\w*(?:(?:/|::|\.)\w+)+")


def parts_of(
    given: Given, facts: NodeFacts, units: Units, known: set[tuple[str, int]], hints: Mapping[str, NodeHint]
) -> tuple[EndpointFact, ...]:
    """Return the endpoints of code that hints and parameters say is loaded into a node.

    Args:
        given: what starts the node.
        facts: of it.
        units: of the workspace.
        known: where the endpoints are made that the node has anyway.
        hints: of the user.
    """
    found: list[EndpointFact] = []
    seen = set(known)
    for name, why in _named(given, facts, units, hints):
        for part in units.parts(name):
            places = set(places_of(part))
            if part.generation == given.generation and not places <= seen:
                found += [_doubted(one, why) for one in part.endpoints]
                seen |= places
    return tuple(found)


def _named(given: Given, facts: NodeFacts, units: Units, hints: Mapping[str, NodeHint]) -> Iterator[tuple[str, str]]:
    """Yield names of code that is loaded into a node, and the source of that fact."""
    node, launched = place_of(given, facts).node.pattern, given.launched
    what = (launched.plugin if launched.plugin.parts else launched.executable).pattern
    hint = hint_of(hints, node, launched.package.pattern, what)
    if hint is not None:
        for name in hint[1].loads:
            yield name, f'{name} is loaded according to [graph.hints."{hint[0]}"]'
    plugins = units.plugins() if given.by_launch else frozenset[str]()
    if not plugins:
        return
    for key, setting in values_of(given, facts).set.items():
        if given.generation == "ros2" or key.startswith(f"{node}/"):
            words = [word for word in _WORD.findall(str(setting.value)) if word in plugins]
            yield from ((word, f"parameter {key} names the plug-in {word}") for word in words)


def _doubted(one: EndpointFact, why: str) -> EndpointFact:
    sure = Sure.LIKELY if one.evidence.sure is Sure.CERTAIN else one.evidence.sure
    return msgspec.structs.replace(one, evidence=msgspec.structs.replace(one.evidence, how=why, sure=sure))
