"""Rule ``graph.private_data``: a topic that only one node uses, with a name that all share."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator

import msgspec

from roslens.model.configuration import Configuration, Origin
from roslens.model.finding import Finding
from roslens.model.graphs.end import End
from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.graph.doubt import weighed
from roslens.source.rules.graph.ends import by_name, ends, is_launched, unknown_nodes
from roslens.source.rules.graph.occurrence import graph_rule, occurrence
from roslens.source.rules.graph.surroundings import Surroundings

Content = Callable[[str], bytes | None]
_WORD = re.compile(rb"\w+")


class Mention(msgspec.Struct, frozen=True, array_like=True):
    """The last part of a name that one node alone uses.

    Attributes:
        name: that part.
        own: files of the node, which do not count.
        found_in: the first other file that holds it; empty where none does.
    """

    name: str
    own: tuple[str, ...]
    found_in: str = ""


RULE = graph_rule(
    "graph.private_data",
    "Private data on a shared name",
    "A node publishes a topic that only it subscribes to, or offers a service or action that only it calls; the name "
    "is not private, its type is defined in the workspace, and no other file of the workspace contains the name. Data "
    "of common types, such as a map, is assumed to be for others. Use `~/name`, or a call within the program.",
    Consequence.MAY_BE_WRONG,
    Certainty.HEURISTIC,
    ("ros", "graph", "names", "reuse"),
    "A name used internally by one node collides with that of another node, or of a second instance, that chooses the "
    "same name.",
)


def found(configuration: Configuration, surroundings: Surroundings) -> Iterator[Finding]:
    """Yield a finding for each name whose both ends are in one node alone, and that nothing else names."""
    own = {one.name for one in surroundings.packages}
    for kind, end in within_one_node(configuration, surroundings):
        if end.type.partition("/")[0] in own and _last(end.name) not in surroundings.mentioned:
            yield _told(kind, end)


def within_one_node(configuration: Configuration, surroundings: Surroundings) -> Iterator[tuple[str, End]]:
    """Yield the kind and the first end of each name whose both ends are in one node alone."""
    if not is_launched(configuration) or unknown_nodes(configuration):
        # Who else uses a name is only known where all that run together are.
        return
    for (kind, name), all_ends in by_name(ends(configuration)).items():
        nodes = {end.node.name for end in all_ends}
        roles = {end.role for end in all_ends}
        if len(nodes) != 1 or len(roles) != 2 or surroundings.is_external(name):
            continue
        end = all_ends[0]
        if end.one.proof.origin is Origin.CODE and not name.startswith(end.node.name + "/"):
            yield kind, end


def mentions(
    configuration: Configuration, surroundings: Surroundings, paths: Iterable[str], content: Content
) -> tuple[Mention, ...]:
    """Return the last parts of names within one node, and whether files besides those of the node itself hold them.

    Args:
        configuration: what would run together.
        surroundings: which names are left out anyway.
        paths: of all files of the workspace.
        content: of a file; None where it cannot be read.
    """
    wanted: dict[str, set[str]] = {}
    for _kind, end in within_one_node(configuration, surroundings):
        files = {one.proof.path for one in end.node.endpoints}
        wanted.setdefault(_last(end.name), set()).update(files)
    found_in: dict[str, str] = {}
    for path in paths if wanted else ():
        left = [name for name, files in wanted.items() if name not in found_in and path not in files]
        words = words_of(content(path)) if left else frozenset[bytes]()
        found_in.update((name, path) for name in left if name.encode() in words)
    return tuple(Mention(name, tuple(sorted(files)), found_in.get(name, "")) for name, files in wanted.items())


def words_of(text: bytes | None) -> frozenset[bytes]:
    """Return the words of a file; none where it cannot be read."""
    return frozenset(_WORD.findall(text)) if text else frozenset()


def _last(name: str) -> str:
    return name.rpartition("/")[2]


def _told(kind: str, end: End) -> Finding:
    certainty, doubt = weighed(RULE.certainty, (end.one.proof,), end.conditions)
    message = (
        f"only {end.label} itself uses both ends of {kind} {end.name}, and no other file of the workspace names it. "
        f"Call it `~/{_last(end.name)}`, if nothing outside of the workspace uses it."
    )
    return occurrence(RULE, message, end.one.proof, entity=end.entity, certainty=certainty, doubt=doubt)
