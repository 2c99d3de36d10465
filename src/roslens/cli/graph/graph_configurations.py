"""The configurations of a workspace that pages show and that a check looks at: those declared, or what is launched."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from operator import attrgetter
from typing import TYPE_CHECKING

import msgspec

from roslens.model.configuration import Configuration, Standing
from roslens.model.errors import RoslensError
from roslens.model.failure import Failure
from roslens.model.finding import Finding
from roslens.model.graphs.graph_scope import GraphScope
from roslens.model.judged_configuration import JudgedConfiguration

if TYPE_CHECKING:
    from roslens.cli.graph.graph_source import GraphSource
    from roslens.cli.graph.kept_configurations import KeptConfigurations
    from roslens.source.extract.facts.launched import Launch
    from roslens.source.progress import Progress

LOOKING = "Looking at configurations"
"""The step in which they are assembled, one by one."""

MOST = 8
"""Maximum number of launch files that are shown without a declaration: those that together start most nodes."""


class Named(msgspec.Struct, frozen=True):
    """A configuration by the name that it is shown under: a launch file with arguments."""

    name: str
    launch: str
    arguments: dict[str, str] = {}


class Assembled(msgspec.Struct, frozen=True):
    """Configurations by name, what the rules of the graph find in each, and what could not be assembled.

    ``unstarted`` is what no known program starts; ``among`` how many configurations there were where some were left
    out, else 0.
    """

    configurations: dict[str, Configuration]
    findings: dict[str, tuple[Finding, ...]]
    failures: tuple[Failure, ...] = ()
    unstarted: tuple[Configuration, ...] = ()
    among: int = 0

    @property
    def note(self) -> str:
        """What readers of the pages have to know of those that were left out; empty where none were."""
        return note_of_left_out(len(self.configurations), self.among) if self.among else ""

    def judged(self) -> tuple[JudgedConfiguration, ...]:
        """Return each with what is wrong with it, as a run keeps it."""
        found = (JudgedConfiguration(name, one, self.findings[name]) for name, one in self.configurations.items())
        return (*found, *(JudgedConfiguration(f"{one.title} ({one.generation})", one) for one in self.unstarted))

    def all_findings(self) -> tuple[Finding, ...]:
        """Return the findings of all configurations, sorted by place; what several have in common once.

        Where it reads differently in several, as what comes near to a name does, the most severe one has its say, and
        of these the first.
        """
        every: dict[str, Finding] = {}
        for found in self.findings.values():
            for finding in found:
                known = every.get(finding.fingerprint)
                if known is None or finding.severity.rank > known.severity.rank:
                    every[finding.fingerprint] = finding
        order = attrgetter("path", "line", "column", "rule", "entity", "message")
        return tuple(sorted(every.values(), key=order))


def note_of_left_out(shown: int, among: int) -> str:
    """Return which launch files have pages, and how others get some."""
    return (
        f"{shown} of {among} launch files are shown, those that together start most nodes; "
        "`[graph.configurations]` in `roslens.toml` chooses others."
    )


def named_configurations(source: GraphSource) -> tuple[Named, ...]:
    """Return what ``roslens.toml`` declares, or else each launch file that no other includes."""
    if declared := source.settings.graph.configurations:
        return tuple(Named(name, one.launch, one.given()) for name, one in declared.items())
    return _first_launch_files(source)


def _first_launch_files(source: GraphSource) -> tuple[Named, ...]:
    paths = source.first_launch_files()
    often = Counter(path.rpartition("/")[2] for path in paths)
    return tuple(
        Named(path if often[name := path.rpartition("/")[2]] > 1 else name, f"{source.root}/{path}") for path in paths
    )


class Chosen(msgspec.Struct, frozen=True):
    """The configurations that are looked at, in order, and the launch files that are not, as paths."""

    named: tuple[Named, ...]
    left_out: tuple[str, ...] = ()

    def scope(self) -> GraphScope:
        """Return what a run keeps of the choice."""
        return GraphScope(tuple(one.name for one in self.named), self.left_out)


def chosen_configurations(source: GraphSource, *, every: bool = False) -> Chosen:
    """Return what ``roslens.toml`` declares, or else the launch files that together start most nodes.

    Args:
        source: the workspace.
        every: whether to look at each launch file that no other includes, however many there are.
    """
    if not every and source.settings.graph.configurations:
        return Chosen(named_configurations(source))
    named = _first_launch_files(source)
    if every:
        names = {one.name for one in named}
        declared = [one for one in named_configurations(source) if one.name not in names]
        return Chosen((*declared, *named))
    shown = largest(source, named)
    left_out = {one.launch for one in named} - {one.launch for one in shown}
    return Chosen(shown, tuple(sorted(launch.removeprefix(f"{source.root}/") for launch in left_out)))


def largest(source: GraphSource, named: Sequence[Named], most: int = MOST) -> tuple[Named, ...]:
    """Return those that together start most nodes, in their order."""
    if len(named) <= most:
        return tuple(named)
    started = {one.name: _started(source.evaluated(one.launch, one.arguments)[1]) for one in named}
    kept = most_telling(started, most)
    return tuple(one for one in named if one.name in kept)


def _started(launch: Launch) -> tuple[str, ...]:
    return tuple(sorted(f"{one.namespace}{one.name}{one.package}{one.executable}{one.plugin}" for one in launch.nodes))


def most_telling(started: Mapping[str, tuple[str, ...]], most: int = MOST) -> frozenset[str]:
    """Return which configurations together start most nodes: one that starts almost the same as another adds little.

    Args:
        started: the names of the nodes that each of them starts.
        most: so many are returned.
    """
    left = {name: set(nodes) for name, nodes in started.items()}
    chosen: list[str] = []
    seen: set[str] = set()
    while left and len(chosen) < most:
        best = min(left, key=lambda name: (-len(left[name] - seen), -len(started[name]), name))
        seen |= left.pop(best)
        chosen.append(best)
    return frozenset(chosen)


def telling_first(found: Assembled) -> Assembled:
    """Return the same, those first of which most nodes are known."""

    def order(name: str) -> tuple[int, int, str]:
        nodes = found.configurations[name].nodes
        return (-sum(node.resolved for node in nodes), -len(nodes), name)

    names = sorted(found.configurations, key=order)
    return Assembled(
        {name: found.configurations[name] for name in names},
        {name: found.findings[name] for name in names},
        found.failures,
        found.unstarted,
        found.among,
    )


def assembled(
    source: GraphSource,
    named: Sequence[Named],
    progress: Progress | None = None,
    kept: KeptConfigurations | None = None,
) -> Assembled:
    """Assemble configurations and look at them; one that cannot be assembled is a failure and the others stay.

    Args:
        source: the workspace.
        named: which ones.
        progress: who watches.
        kept: what an earlier run found in them; None for nothing.
    """
    from roslens.cli.graph.graph_linked import with_linked
    from roslens.source.progress import Silent

    watch = progress or Silent()
    watch.step(LOOKING, len(named))
    configurations: dict[str, Configuration] = {}
    findings: dict[str, tuple[Finding, ...]] = {}
    failures: list[Failure] = []
    for one in named:
        try:
            made, found = _looked(source, one, kept)
        except Exception as error:  # noqa: BLE001 - one configuration must not lose the others
            failures.append(_failure(one, error))
        else:
            configurations[one.name], findings[one.name] = made, found
            if not made.nodes and not _is_elsewhere(source.evaluated(one.launch, one.arguments)[1]):
                failures.append(_empty(one, made))
        watch.advance(item=one.name)
    unstarted: tuple[Configuration, ...] = ()
    try:
        unstarted = _unstarted(source, kept)
        linked = with_linked(tuple(configurations.values()), unstarted, source.facts)
        configurations = dict(zip(configurations, linked, strict=True))
    except Exception as error:  # noqa: BLE001 - configurations stay, whatever the rest of the code is like
        failures.append(_failure(Named("what no known program starts", ""), error))
    return Assembled(configurations, findings, (*failures, *source.facts.broken), unstarted)


def _looked(
    source: GraphSource, one: Named, kept: KeptConfigurations | None
) -> tuple[Configuration, tuple[Finding, ...]]:
    """Return a configuration, and what the rules of the graph find in it."""
    from roslens.cli.graph.graph_findings import findings_of

    def look() -> tuple[Configuration, tuple[Finding, ...]]:
        made = source.launched(one.launch, one.arguments)
        # What is declared is known by its name: how it is started, and whether it is whole.
        declared = one.name in source.settings.graph.configurations
        return made, tuple(findings_of(source, made, one.name if declared else one.launch, one.arguments))

    if kept is None:
        return look()
    from roslens.cli.graph.kept_configurations import Looked

    def looked() -> Looked:
        made, found = look()
        return Looked((made,), found)

    known = kept.looked(
        f"{one.name} {one.launch}", one.arguments, source.evaluated(one.launch, one.arguments)[1], looked
    )
    return known.configurations[0], known.findings


def _unstarted(source: GraphSource, kept: KeptConfigurations | None) -> tuple[Configuration, ...]:
    """Return what no known program starts."""
    if kept is None:
        return source.unstarted(())
    from roslens.cli.graph.kept_configurations import Looked

    return kept.looked("", {}, None, lambda: Looked(source.unstarted(()))).configurations


def _failure(one: Named, error: Exception) -> Failure:
    what = f'configuration "{one.name}": '
    if isinstance(error, RoslensError):
        return Failure("graph", what + error.what, expected=error.expected, advice=error.advice)
    import traceback

    return Failure(
        "graph",
        f"{what}{type(error).__name__}: {error}",
        expected="a launch file that can be evaluated",
        advice="Please report it with the file: this is a bug in roslens",
        detail="".join(traceback.format_exception(error)),
    )


def _is_elsewhere(launch: Launch) -> bool:
    """Whether a launch file starts programs that are no nodes, as a recorder, or includes what is not here."""
    return bool(launch.nodes) or any(one.standing is Standing.OUTSIDE for one in launch.unresolved)


def _empty(one: Named, made: Configuration) -> Failure:
    reasons = [f"{reason.proof.place}: {reason.reason}" for reason in made.unresolved[:1]]
    return Failure(
        "graph",
        f'configuration "{one.name}" starts no node that could be read',
        expected="a launch file that starts at least one",
        advice="; ".join(reasons) or f"Look at it with `roslens graph --launch {one.launch}`",
    )
