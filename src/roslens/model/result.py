"""What an analysis run yields: per package, and for the workspace as a whole."""

from __future__ import annotations

import msgspec

from roslens.model.entity import Entity
from roslens.model.failure import Failure
from roslens.model.finding import Finding, RuleInfo, Severity
from roslens.model.graphs.graph_scope import GraphScope
from roslens.model.process import RepositoryProcess
from roslens.model.quantity import Quantity
from roslens.model.repository import FoundRepository
from roslens.model.set_aside import SetAside
from roslens.model.source import Package, SourceFile
from roslens.model.weight.consequence import Certainty, Consequence, supposed


class RoleInclude(msgspec.Struct, frozen=True, array_like=True):
    """An include or import that indicates the role of its package.

    Attributes:
        kind: ``devices`` or ``tasks``.
        name: of the header or module.
        path: of the first file that has it.
        line: in that file.
    """

    kind: str
    name: str
    path: str
    line: int


class PackageResult(msgspec.Struct, frozen=True, omit_defaults=True):
    """Everything known of one package; the unit that runs share when nothing in it changed.

    ``entities`` holds the package itself first, then its files, classes and functions; ``set_aside`` the findings that
    do not count because somebody said so; ``includes`` what sources include that tells the package's role.
    """

    package: Package
    files: tuple[SourceFile, ...] = ()
    entities: tuple[Entity, ...] = ()
    findings: tuple[Finding, ...] = ()
    failures: tuple[Failure, ...] = ()
    set_aside: tuple[SetAside, ...] = ()
    includes: tuple[RoleInclude, ...] = ()


class RuleCount(msgspec.Struct, frozen=True, omit_defaults=True):
    """How often a rule was broken in a package, with its worst occurrence as the example.

    A rule has one count for each severity, certainty and set of tags that its findings have; ``gated`` is how
    many of them count for gates, ``fixable`` how many of these have a fix; ``excess`` is how far the example is beyond
    its bound; ``path`` is the file of the example, below the workspace; ``consequence`` and ``certainty`` are None
    where its tool declares none. ``line`` is that of the example, ``also`` are rules that report it too, and ``alike``
    is of how many other places a row says the same.
    """

    rule: str
    severity: Severity
    count: int
    gated: int = 0
    example: str = ""
    tags: tuple[str, ...] = ()
    excess: float = 0.0
    fixable: int = 0
    path: str = ""
    consequence: Consequence | None = None
    certainty: Certainty | None = None
    line: int = 0
    also: tuple[str, ...] = ()
    alike: int = 0

    @property
    def weight(self) -> tuple[Consequence, Certainty]:
        """Consequence and certainty; what its severity lets suppose where its tool declares none."""
        if self.consequence is None or self.certainty is None:
            return supposed(self.severity)
        return self.consequence, self.certainty


class PackageSummary(msgspec.Struct, frozen=True, omit_defaults=True):
    """What overview, graph and terminal need of a package, small enough to load all of them.

    ``values`` are the package's own and folded quantities by key. ``languages`` maps a language to
    its number of files. ``limits`` counts, by rule, the limits of quality models that are reasons of a finding
    which stands for several, where it counts for gates. ``includes`` are those of the result. ``copy_of`` is that of
    the package.
    """

    id: str
    name: str
    path: str
    version: str = ""
    build_type: str = ""
    description: str = ""
    repository: str = ""
    metapackage: bool = False
    dependencies: tuple[str, ...] = ()
    values: dict[str, float] = {}
    rules: tuple[RuleCount, ...] = ()
    files: int = 0
    classes: int = 0
    functions: int = 0
    failures: int = 0
    languages: dict[str, int] = {}
    roles: dict[str, int] = {}
    limits: dict[str, int] = {}
    includes: tuple[RoleInclude, ...] = ()
    copy_of: str = ""


class RunHeader(msgspec.Struct, frozen=True, omit_defaults=True):
    """What was analysed, when, with what.

    ``started`` is UTC in ISO 8601; ``key`` is a hash of all inputs (contents, options, versions of
    analysers): two runs of the same key have the same result. ``commit`` is the commit of the
    workspace's repository, with ``+`` where its tree differs. ``tools`` maps names to versions;
    ``configuration`` holds the options that shape the result, ``models`` and ``plugins`` included, and in
    ``target``, in words, which distributions of ROS the packages are for, as far as known.
    ``repositories`` are those that the packages are in, by path. ``graphs`` is which computation graphs it looked at;
    None for none.
    """

    key: str
    root: str
    paths: tuple[str, ...] = ()
    started: str = ""
    seconds: float = 0.0
    commit: str = ""
    tools: dict[str, str] = {}
    configuration: dict[str, object] = {}
    models: tuple[str, ...] = ()
    repositories: tuple[FoundRepository, ...] = ()
    graphs: GraphScope | None = None

    @property
    def commits(self) -> tuple[tuple[str, str], ...]:
        """The commit of each repository, as far as known, by its place; ``.`` where the workspace lies in one."""
        if self.commit:
            return ((".", self.commit),)
        return tuple((one.path, one.commit) for one in self.repositories if one.commit)


class WorkspaceResult(msgspec.Struct, frozen=True, omit_defaults=True):
    """What only the packages together show.

    ``package_values`` maps package ids to quantities that need all packages (``dependents``,
    ``tier``, ``cycle``), ``package_findings`` to findings that do, as those of a computation graph;
    ``findings`` and ``failures`` belong to no package; ``rules`` describe every rule that a
    finding of the run may name, ``quantities`` everything that may have been measured; ``set_aside`` are findings that
    only all packages together show, or that belong to no package; ``process`` is what the histories of
    repositories say, where it was asked for.
    """

    package_values: dict[str, dict[str, float]] = {}
    package_findings: dict[str, tuple[Finding, ...]] = {}
    findings: tuple[Finding, ...] = ()
    failures: tuple[Failure, ...] = ()
    rules: tuple[RuleInfo, ...] = ()
    quantities: tuple[Quantity, ...] = ()
    process: tuple[RepositoryProcess, ...] = ()
    set_aside: tuple[SetAside, ...] = ()
