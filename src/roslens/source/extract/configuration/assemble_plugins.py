"""Which plug-ins the nodes of a process load: what launch files set is given to their code, and that evaluated again.

A plug-in may load others, by parameters that only its own code knows: it takes some turns until nothing is asked anew.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence

import msgspec

from roslens.source.extract.facts.chosen import Chosen, node_key
from roslens.source.extract.facts.meant import Meant
from roslens.source.extract.facts.node_facts import EndpointFact, Evidence, NodeFacts, PluginFact, Sure
from roslens.source.extract.parameters.assemble_parameters import Values
from roslens.source.extract.symbolic.text import Hole, Text
from roslens.source.extract.symbolic.text_lists import listed

MOST_TURNS = 6
_MOST_ITEMS = 64

Again = Callable[[Chosen], Meant]
"""Evaluates what is started with what decides which plug-ins are loaded."""


def with_plugins(meant: Meant, again: Again, values: Callable[[NodeFacts, int], Values]) -> Meant:
    """Return what is started with what its plug-ins make; ``values`` are the parameters of each node of it."""
    first = meant
    chosen = Chosen()
    for turn in range(MOST_TURNS):
        new = dict.fromkeys((*chosen.values, *_wanted(meant.facts, values)))
        written = not turn and any(plugin.type.known for one in meant.facts for plugin in one.plugins)
        if len(new) == len(chosen.values) and not written:
            break
        chosen = Chosen(tuple(new))
        turned = again(chosen)
        if not turned.facts:
            return first
        meant = turned
    if meant is first:
        return _reported(meant)
    return _reported(msgspec.structs.replace(meant, facts=tuple(_doubted(first.facts, meant.facts))))


def _wanted(
    facts: Sequence[NodeFacts], values: Callable[[NodeFacts, int], Values]
) -> Iterator[tuple[str, str, str | None]]:
    """Yield the parameters that decide which classes nodes load, with what they are set to."""
    for number, node in enumerate(facts):
        asked = [one for one in (*(plugin.type for plugin in node.plugins), *node.asks) if one.holes]
        if not asked:
            continue
        known, key = values(node, number), node_key(node)
        for text in asked:
            for name in _asked(text, known):
                found = known.value(Text.of(name))
                yield key, name, None if found is None else found.value.known


def _asked(text: Text, values: Values) -> Iterator[str]:
    """Yield the names of the parameters that decide a text, lists that others are named after before those."""
    for hole in text.holes:
        for one in hole.choice:
            yield from _asked(one.then, values)
            yield from _asked(one.otherwise, values)
        if hole.named:
            yield from _asked(hole.named[0], values)
            yield from _named(hole.named[0], values)
        elif hole.parameter and "*" not in hole.parameter:
            yield hole.parameter


def _named(name: Text, values: Values) -> Iterator[str]:
    """Yield the names that a name with items of a list in it stands for."""
    if not name.holes:
        yield name.pattern
        return
    place = name.parts.index(name.holes[0])
    for item in _items(name.holes[0], values):
        yield from _named(Text.of(*name.parts[:place], item, *name.parts[place + 1 :]), values)


def _items(hole: Hole, values: Values) -> list[str]:
    found = values.value(Text.of(hole.parameter)) if hole.parameter else None
    value = (hole.among or hole.default) if found is None else found.value.known
    if value is None:
        return []
    return listed(value)[:_MOST_ITEMS] if value.startswith("[") else [value]


def _doubted(before: Sequence[NodeFacts], after: Sequence[NodeFacts]) -> Iterator[NodeFacts]:
    """Yield facts in which what plug-ins make that defaults name is no surer than these."""
    known = {(node_key(one), _place(end)) for one in before for end in one.endpoints}
    for node in after:
        usual = [one for one in node.plugins if one.type.holes and one.made]
        if not usual:
            yield node
            continue
        how = "created by plug-ins that parameter defaults name"
        yield msgspec.structs.replace(
            node,
            endpoints=tuple(
                one if (node_key(node), _place(one)) in known else _likely(one, how) for one in node.endpoints
            ),
        )


def _place(fact: EndpointFact) -> tuple[str, Evidence]:
    return fact.role.value, msgspec.structs.replace(fact.evidence, how="", sure=Sure.CERTAIN)


def _likely(fact: EndpointFact, how: str) -> EndpointFact:
    if fact.evidence.sure is not Sure.CERTAIN:
        return fact
    return msgspec.structs.replace(fact, evidence=msgspec.structs.replace(fact.evidence, sure=Sure.LIKELY, how=how))


def _reported(meant: Meant) -> Meant:
    """Return what is started with what of its plug-ins is not known."""
    if not any(one.plugins for one in meant.facts):
        return meant
    facts = []
    for one in meant.facts:
        made = {plugin.evidence for plugin in one.plugins if plugin.made}
        missed = [_miss(plugin) for plugin in one.plugins if not plugin.made and plugin.evidence not in made]
        facts.append(msgspec.structs.replace(one, unresolved=tuple(dict.fromkeys((*one.unresolved, *missed)))))
    return msgspec.structs.replace(meant, facts=tuple(facts))


def _miss(plugin: PluginFact) -> tuple[Evidence, str]:
    what = f"a plug-in of {plugin.base}" if plugin.base else "a plug-in"
    name = plugin.type.usual
    if name:
        reason = f"{what} is loaded, {name}, which is not in the workspace: its endpoints are unknown"
    else:
        why = "; ".join(dict.fromkeys(str(hole.reason) for hole in plugin.type.holes)) or "an empty name"
        reason = f"{what} is loaded, and which one depends on {why}: its endpoints are unknown"
    return plugin.evidence, reason
