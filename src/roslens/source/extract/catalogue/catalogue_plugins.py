"""What plug-ins make that a node without source loads by its parameters: planners and layers of move_base.

Which node loads what, and what each type makes, is in ``catalogue/move_base/plugins.yaml``.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from functools import cache
from importlib import resources

import msgspec

from roslens.judge.documents.yaml_tree import read_tree
from roslens.source.extract.catalogue.catalogue import RECONFIGURES, plain_value
from roslens.source.extract.catalogue.catalogue_items import items_of
from roslens.source.extract.catalogue.hints import ROLES, endpoint_of
from roslens.source.extract.facts.node_facts import EndpointFact, Evidence, Sure
from roslens.source.extract.parameters.assemble_parameters import Values
from roslens.source.extract.symbolic.text import Text

_OBSERVED = frozenset({"LaserScan", "PointCloud", "PointCloud2"})


class Class(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """Types of plug-ins that make the same.

    Attributes:
        types: as parameters name them.
        source: where their facts can be read.
        reconfigures: namespaces below the plug-in that have a server of dynamic_reconfigure; ``.`` is its own.
        observes: its parameter with the names of sources, each a namespace with ``topic`` and ``data_type``.
    """

    types: tuple[str, ...]
    source: str
    publishes: tuple[str, ...] = ()
    subscribes: tuple[str, ...] = ()
    serves: tuple[str, ...] = ()
    serves_actions: tuple[str, ...] = ()
    reconfigures: tuple[str, ...] = ()
    observes: str = ""

    def lines(self) -> Iterator[tuple[str, str]]:
        """Yield key and line of each endpoint."""
        for key in ROLES:
            yield from ((key, line) for line in getattr(self, key, ()))
        for space in self.reconfigures:
            yield from ((key, line if space == "." else f"{space}/{line}") for key, line in RECONFIGURES)


class Host(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """A node of the catalogue that loads plug-ins, see the file for the form of ``loads``."""

    package: str
    node: str
    source: str
    loads: tuple[str, ...]


class _File(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    hosts: tuple[Host, ...]
    classes: tuple[Class, ...]


def plugged_by_parameters(package: str, node: str, values: Values) -> Iterator[EndpointFact]:
    """Yield what the plug-ins of a node make, as its parameters or their defaults name them.

    Args:
        package: that has the node.
        node: the executable.
        values: of its parameters.
    """
    host = _hosts().get((package, node))
    for line in host.loads if host is not None else ():
        loaded, _, space = line.partition(" in ")
        for kind, name in _loaded(loaded, values):
            found = _classes().get(kind)
            if found is None:
                continue
            how = (
                f"plug-in {kind} creates it, as named by parameter {loaded.partition('=')[0]}; differs between releases"
            )
            evidence = Evidence(found.source, 0, 0, how, Sure.LIKELY)
            below = space.replace("{last}", kind.replace("::", "/").rpartition("/")[2]).replace("{name}", name)
            for key, end in found.lines():
                yield endpoint_of(f"{below}/{end}", ROLES[key], "ros1", evidence)
            if found.observes:
                yield from _observed(below, found.observes, values, evidence)


def _observed(below: str, parameter: str, values: Values, evidence: Evidence) -> Iterator[EndpointFact]:
    """Yield a subscription for each source that a parameter names: words in one text (obstacle_layer.cpp)."""
    for source in (_known(f"{below}/{parameter}", values) or "").split():
        topic = values.value(Text.of(f"{below}/{source}/topic"))
        kind = _known(f"{below}/{source}/data_type", values) or "PointCloud"
        if kind in _OBSERVED:
            fact = endpoint_of(f"x sensor_msgs/{kind} 50", ROLES["subscribes"], "ros1", evidence)
            yield msgspec.structs.replace(fact, name=Text.of(source) if topic is None else topic.value)


def _known(name: str, values: Values) -> str | None:
    setting = values.value(Text.of(name))
    return None if setting is None else setting.value.known


def _loaded(loaded: str, values: Values) -> Iterator[tuple[str, str]]:
    """Yield type and name of what a parameter names."""
    parameter, _, default = loaded.partition("=")
    if parameter.endswith("[]"):
        for item in items_of(parameter.removesuffix("[]"), values) or ():
            if item.get("type") and item.get("name"):
                yield item["type"], item["name"]
        return
    setting = values.value(Text.of(parameter))
    yield (default if setting is None else setting.value.known or ""), ""


@cache
def _read() -> _File:
    folder = resources.files("roslens.source.extract").joinpath("catalogue").joinpath("move_base")
    tree = read_tree(folder.joinpath("plugins.yaml").read_bytes(), "plugins.yaml")
    return msgspec.convert(plain_value(tree.root), _File, strict=False)


@cache
def _hosts() -> Mapping[tuple[str, str], Host]:
    return {(one.package, one.node): one for one in _read().hosts}


@cache
def _classes() -> Mapping[str, Class]:
    return {kind: one for one in _read().classes for kind in one.types}
