"""Rule ``graph.dependency``: an interface that is used and not declared as a dependency."""

from __future__ import annotations

from collections.abc import Iterator

from roslens.model.configuration import Configuration, ConfiguredEndpoint, Origin
from roslens.model.finding import Finding
from roslens.model.graphs.end import VERB, End
from roslens.model.source import Package
from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.graph.brought_along import brought_by, may_be_brought_by
from roslens.source.rules.graph.doubt import weighed
from roslens.source.rules.graph.ends import order_of
from roslens.source.rules.graph.occurrence import graph_rule, occurrence
from roslens.source.rules.graph.surroundings import Surroundings

RULE = graph_rule(
    "graph.dependency",
    "Undeclared dependency on an interface package",
    "Code of a package uses a message, service or action of another package that its package.xml does not depend on. "
    "If the other package is a transitive dependency, it is a note: it may disappear with a change of the dependency. "
    "Add `<depend>`.",
    Consequence.HARD_TO_MAINTAIN,
    Certainty.LIKELY,
    ("ros", "graph", "dependencies", "package"),
    "It builds if the package happens to be installed, and fails on a clean machine or the build farm.",
)
_OF_LIBRARIES = frozenset({"tf2_msgs", "tf", "dynamic_reconfigure", "actionlib_msgs", "diagnostic_msgs", "bond"})
_COUNT = frozenset({"depend", "build", "build_export", "exec", "run"})


def found(configuration: Configuration, surroundings: Surroundings) -> Iterator[Finding]:
    """Yield a finding for each package and each interface package that it lacks."""
    lacking: dict[tuple[str, str], list[End]] = {}
    packages = {}
    for node in configuration.nodes:
        for one in node.endpoints:
            owner = one.endpoint.type.partition("/")[0]
            if one.implicit or one.proof.origin is not Origin.CODE or not _is_written(one, owner):
                continue
            package = _package_of(one.proof.path, surroundings.packages)
            if package is not None and not _depends(package, owner):
                packages[package.id] = package
                lacking.setdefault((package.id, owner), []).append(End(node, one))
    for (package_id, owner), used in sorted(lacking.items()):
        package = packages[package_id]
        yield _told(package, owner, min(used, key=order_of), surroundings.packages)


def _is_written(one: ConfiguredEndpoint, owner: str) -> bool:
    """Whether the code names the type: those of broadcasters, updaters and the like are the library's own."""
    return "/" in one.endpoint.type and one.proof.line > 0 and owner not in _OF_LIBRARIES


def _package_of(path: str, packages: tuple[Package, ...]) -> Package | None:
    """Return the innermost package that a file is in."""
    around = [one for one in packages if one.path in ("", ".") or path.startswith(f"{one.path}/")]
    return max(around, key=lambda one: len(one.path), default=None)


def _depends(package: Package, owner: str) -> bool:
    return owner == package.name or any(one.name == owner and one.kind in _COUNT for one in package.dependencies)


def _told(package: Package, owner: str, end: End, packages: tuple[Package, ...]) -> Finding:
    along = brought_by(package, owner, packages)
    perhaps = "" if along else may_be_brought_by(package, owner, packages)
    certainty, doubt = weighed(
        Certainty.HEURISTIC if along else RULE.certainty,
        (end.one.proof,),
        more=f"`{perhaps}` may depend on it" if perhaps else "",
    )
    only = f" It is available because `{along}` depends on it." if along else ""
    message = (
        f"{end.label} {VERB[end.role]} {end.name} as {end.type}, but {package.manifest.path} does not depend on "
        f"`{owner}`.{only} Add `<depend>{owner}</depend>`."
    )
    return occurrence(
        RULE, message, end.one.proof, entity=f"package:{package.id}", certainty=certainty, context=owner, doubt=doubt
    )
