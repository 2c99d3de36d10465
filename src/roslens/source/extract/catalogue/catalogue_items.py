"""Names that come one by one from parameters of a node without source: a list of maps, or parameters side by side.

The catalogue writes ``{~topics[].topic}`` for the ``topic`` of each map in the list ``~topics``, and
``{topics.*.topic}`` for each parameter of such a name.
"""

from __future__ import annotations

from collections.abc import Iterator
from fnmatch import fnmatchcase

import msgspec

from roslens.judge.documents.yaml_tree import Items, Table, read_tree
from roslens.model.errors import DocumentError
from roslens.source.extract.facts.node_facts import EndpointFact
from roslens.source.extract.parameters.assemble_parameters import Values
from roslens.source.extract.symbolic.text import Hole, Text, unknown

_EACH, _ANY = "[].", ".*."


def each_item(fact: EndpointFact, values: Values) -> Iterator[EndpointFact]:
    """Yield an endpoint for each item that its name comes from: itself where it comes from none."""
    for part in fact.name.holes:
        if _EACH in part.parameter or _ANY in part.parameter:
            place = fact.name.parts.index(part)
            items = _of_list(part.parameter, values) if _EACH in part.parameter else _side_by_side(part, values)
            for one in items:
                name = Text.of(*fact.name.parts[:place], one, *fact.name.parts[place + 1 :])
                yield msgspec.structs.replace(fact, name=name)
            return
    yield fact


def _of_list(parameter: str, values: Values) -> Iterator[Text]:
    name, _, key = parameter.partition(_EACH)
    setting = values.value(Text.of(name))
    if setting is None:
        return
    if setting.value.known is None:
        yield unknown(f"{key} of each item of {name}")
        return
    items = items_of(name, values)
    if items is None:
        yield unknown(f"{key} of each item of {name}, which is not a list")
    for item in items or ():
        if key in item:
            yield Text.of(item[key])


def items_of(name: str, values: Values) -> list[dict[str, str]] | None:
    """Return the maps of a list that a parameter is, with their plain values; None where it is no known list."""
    setting = values.value(Text.of(name))
    if setting is None or setting.value.known is None:
        return None
    try:
        root = read_tree(setting.value.known.encode(), setting.evidence.path).root
    except DocumentError:
        return None
    match root:
        case Items(nodes=nodes):
            return [item.texts for item in nodes if isinstance(item, Table)]
    return None


def _side_by_side(hole: Hole, values: Values) -> Iterator[Text]:
    before, _, after = hole.parameter.partition(_ANY)
    for name, setting in values.set.items():
        middle = name.removeprefix(f"{before}.").removesuffix(f".{after}")
        if fnmatchcase(name, f"{before}.*.{after}") and "." not in middle:
            yield setting.value
