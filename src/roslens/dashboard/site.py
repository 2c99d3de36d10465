"""What all pages show: one run, the quantities and models that explain it, the sources it is about."""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Callable, Iterable, Mapping, Sequence
from functools import cached_property
from pathlib import PurePath
from typing import TYPE_CHECKING

import msgspec

from roslens.dashboard.last_change import LastChange, unknown_change
from roslens.dashboard.review import Review
from roslens.dashboard.sources.source_text import ReadSource, Sources
from roslens.dashboard.totals import FilePlace, RuleTotal, by_rule, totals_of
from roslens.judge.quality.constraint import Constraint
from roslens.judge.quality.select import EVERY
from roslens.judge.ranges.range import Range
from roslens.judge.ranges.rate import rate
from roslens.model.entity import EntityKind
from roslens.model.failure import Failure
from roslens.model.finding import Finding, RuleInfo, Severity
from roslens.model.quantity import Quantity
from roslens.model.result import PackageSummary, RuleCount
from roslens.model.source import SourceFile, number_of_packages
from roslens.model.tags import TagFilter
from roslens.model.verdict import State
from roslens.report.run.fix_first import counted

if TYPE_CHECKING:
    from roslens.compare.conformance.disparity import Conformance
    from roslens.compare.conformance.side import Side
    from roslens.dashboard.computation.book import Book
    from roslens.dashboard.computation.code_marks import CodeMarks
    from roslens.dashboard.gate_line import GateLine
    from roslens.dashboard.live.snapshot import Named
    from roslens.dashboard.past import Past
    from roslens.dashboard.since_run import SinceRun
    from roslens.judge.quality.quality_model import QualityModel
    from roslens.model.configuration import Configuration
    from roslens.store.read import RunView
    from roslens.store.runs import StoredRun


def _no_source(path: str) -> bytes | None:  # noqa: ARG001 - the shape of every reader
    return None


class Site:
    """A run with everything that its pages need; loads what is asked and keeps what is small."""

    def __init__(
        self,
        view: RunView,
        *,
        quantities: Mapping[str, Quantity],
        models: Sequence[QualityModel] = (),
        read_source: ReadSource = _no_source,
        configurations: Mapping[str, Configuration] | None = None,
        about: Mapping[str, Sequence[Finding]] | None = None,
        graph_note: str = "",
        graphs_counted: bool = True,
        unstarted: Sequence[Configuration] = (),
    ) -> None:
        """Bring a run and its explanations together.

        Args:
            view: the run.
            quantities: everything that may have been measured, by key.
            models: quality models whose thresholds are shown; the run's own first.
            read_source: gives the content of a file by its path below the workspace root, None where it cannot.
            configurations: whose computation graphs are shown, by name.
            about: findings about each of them, by the same names.
            graph_note: what readers of these graphs have to know, as that they are not those of the run.
            graphs_counted: whether the findings about them are among those of the run.
            unstarted: what no known program starts.
        """
        self.view = view
        self.quantities = dict(quantities)
        self.models = tuple(models)
        self.sources = Sources(read_source, self._file_of)
        self._configurations = dict(configurations or {})
        self._about = dict(about or {})
        self._graph_note = graph_note
        self._graphs_counted = graphs_counted
        self._unstarted = tuple(unstarted)
        self._marks: tuple[Book, CodeMarks] | None = None
        self.past: Past | None = None
        """Past revisions; None where none were analysed."""
        self.new_first: tuple[RuleCount, ...] = ()
        """What to mend first of what is new since the baseline of the last check."""
        self.changes: Mapping[str, int] = {}
        """In how many commits of the last year files of findings changed, as far as the last check knew."""
        self.last_change: Callable[[str], LastChange | None] = unknown_change
        """Returns who changed a file last, by its path below the workspace root; None if unknown."""
        self.runs: Sequence[StoredRun] = ()
        """The runs that are kept, where there are others than this one."""
        self.since: SinceRun | None = None
        """The run against the one before; None where none was kept."""
        self.gate: GateLine | None = None
        """Whether it passes; None if not requested."""
        self.running: Callable[[], Sequence[Named]] = tuple
        """Describes what is watched now, or was recorded."""
        self.against: Callable[[str], tuple[str, Conformance, list[Side]]] | None = None
        """Compares a configuration by its slug with what runs or was recorded; None where nothing is given."""
        self.review: Review | None = None
        """What the team decided about findings; None where that is not known."""
        self.reading = ""
        """What of the graphs is being read still; empty where all of them are there."""

    def _file_of(self, path: str) -> SourceFile | None:
        place = self.places.get(path)
        return place.file if place else None

    @property
    def name(self) -> str:
        """The name of the workspace: the last meaningful part of its root."""
        parts = [part for part in PurePath(self.view.header.root).parts if part not in {"/", "src"}]
        return parts[-1] if parts else self.view.header.root

    @cached_property
    def packages(self) -> tuple[PackageSummary, ...]:
        """All packages, by id."""
        return self.view.packages()

    @cached_property
    def by_id(self) -> dict[str, PackageSummary]:
        """Package id to package."""
        return {package.id: package for package in self.packages}

    @cached_property
    def _ids_of_name(self) -> dict[str, str]:
        # Where a name is doubled, a dependency means the first: which one a build takes is not ours to know.
        ids: dict[str, str] = {}
        for package in self.packages:
            ids.setdefault(package.name, package.id)
        return ids

    @cached_property
    def dependencies(self) -> dict[str, tuple[str, ...]]:
        """Package id to the ids of the packages in the workspace that it needs, in order of their names."""
        ids = self._ids_of_name
        return {
            package.id: tuple(ids[name] for name in package.dependencies if name in ids and ids[name] != package.id)
            for package in self.packages
        }

    @cached_property
    def dependents(self) -> dict[str, tuple[str, ...]]:
        """Package id to the ids of the packages that need it."""
        found: dict[str, list[str]] = {package.id: [] for package in self.packages}
        for package, needs in self.dependencies.items():
            for needed in needs:
                found[needed].append(package)
        return {package: tuple(others) for package, others in found.items()}

    def outside_dependencies(self, package: str) -> tuple[str, ...]:
        """Return the names of packages that this one needs and that the workspace does not hold."""
        return tuple(name for name in self.by_id[package].dependencies if name not in self._ids_of_name)

    @cached_property
    def places(self) -> dict[str, FilePlace]:
        """Path to file and package."""
        return {file.path: FilePlace(package, file) for package, file in self.view.files()}

    @cached_property
    def rules(self) -> dict[str, RuleInfo]:
        """Rule id to rule; rules that findings name without a declaration are there too."""
        known = {rule.id: rule for rule in self.view.rules()}
        for package in self.packages:
            for count in package.rules:
                if count.rule not in known:
                    known[count.rule] = RuleInfo(count.rule, count.rule, "", count.severity, count.tags)
        for finding in self.view.workspace.findings:
            if finding.rule not in known:
                known[finding.rule] = RuleInfo(finding.rule, finding.rule, "", finding.severity, finding.tags)
        return dict(sorted(known.items()))

    @cached_property
    def shared_findings(self) -> dict[tuple[str, str, str], str]:
        """Rule, path and fingerprint of what only all packages together show, to the package that it is of."""
        return {
            (finding.rule, finding.path, finding.fingerprint): package
            for package, found in self.view.workspace.package_findings.items()
            for finding in found
        }

    @cached_property
    def failures(self) -> tuple[Failure, ...]:
        """What could not be analysed."""
        return self.view.failures()

    @cached_property
    def workspace_counts(self) -> tuple[RuleCount, ...]:
        """Counts of the findings that belong to no package."""
        findings = self.view.workspace.findings
        groups: dict[tuple[object, ...], list[Finding]] = defaultdict(list)
        for one in findings:
            groups[one.rule, one.severity, one.consequence, one.certainty, one.tags].append(one)
        return tuple(
            msgspec.structs.replace(
                counted(found[0]), count=len(found), gated=sum(one.gated for one in found), example="", path="", line=0
            )
            for found in groups.values()
        )

    def counts(self, package: str | None = None) -> Iterable[tuple[str, RuleCount]]:
        """Yield package id and count of every rule broken, in all packages or one; ``""`` is the workspace."""
        for summary in self.packages:
            if package is None or summary.id == package:
                for count in summary.rules:
                    yield summary.id, count
        if not package:
            for count in self.workspace_counts:
                yield "", count

    def rule_totals(
        self,
        *,
        package: str | None = None,
        tags: TagFilter | None = None,
        severities: frozenset[Severity] | None = None,
    ) -> tuple[RuleTotal, ...]:
        """Return the rules broken under these conditions: the gravest first, then the most frequent in own code."""
        wanted = tags or TagFilter()
        return totals_of(
            (owner, count)
            for owner, count in self.counts(package)
            if (not severities or count.severity in severities) and wanted.matches(count.tags)
        )

    def broken_rules(self) -> tuple[RuleTotal, ...]:
        """Return each rule that is broken once, with the gravest severity that its findings have, in the same order."""
        owners: dict[str, set[str]] = defaultdict(set)
        for owner, count in self.counts():
            owners[count.rule].add(owner)
        return by_rule(self.rule_totals(), {rule: number_of_packages(names) for rule, names in owners.items()})

    @cached_property
    def tag_counts(self) -> dict[str, int]:
        """Tag to number of findings that carry it, the most frequent first."""
        counts: Counter[str] = Counter()
        for _, count in self.counts():
            for tag in count.tags:
                counts[tag] += count.count
        return dict(sorted(counts.items(), key=lambda item: (-item[1], item[0])))

    def severity_counts(self, package: str | None = None) -> dict[Severity, int]:
        """Return how many findings of each severity count for gates, the most severe first."""
        return self._by_severity(count for _, count in self.counts(package))

    def severity_counts_of(self, package: PackageSummary, tags: TagFilter | None = None) -> dict[Severity, int]:
        """Return how many findings of each severity count for gates in a package, among those that the tags mean."""
        return self._by_severity(count for count in package.rules if not tags or tags.matches(count.tags))

    @staticmethod
    def _by_severity(counts: Iterable[RuleCount]) -> dict[Severity, int]:
        found = dict.fromkeys((Severity.ERROR, Severity.WARNING, Severity.NOTE), 0)
        for count in counts:
            found[count.severity] += count.gated
        return found

    @staticmethod
    def aside_of(package: PackageSummary, tags: TagFilter | None = None) -> int:
        """Return how many findings of a package do not count for gates: those in test, generated or vendored code."""
        return sum(count.count - count.gated for count in package.rules if not tags or tags.matches(count.tags))

    @staticmethod
    def findings_per_kloc(package: PackageSummary, tags: TagFilter | None = None) -> float | None:
        """Return findings per 1,000 lines of code, both of what counts for gates; None for a package without code."""
        lines = package.values.get("loc")
        if not lines:
            return None
        return 1000 * sum(count.gated for count in package.rules if not tags or tags.matches(count.tags)) / lines

    @cached_property
    def kinds_measured(self) -> dict[str, tuple[EntityKind, ...]]:
        """Quantity key to the kinds of entity that may have a value of it: its own, then those it is folded to."""
        order = (EntityKind.FUNCTION, EntityKind.CLASS, EntityKind.FILE, EntityKind.PACKAGE)
        found: dict[str, tuple[EntityKind, ...]] = {}
        for key, quantity in self.quantities.items():
            own = [kind for kind in order if kind in quantity.kinds]
            lowest = order.index(own[0]) if own else len(order)
            folded = [
                kind for kind in (EntityKind.FILE, EntityKind.PACKAGE) if quantity.folds and order.index(kind) > lowest
            ]
            found[key] = tuple(dict.fromkeys((*own, *folded)))
        return found

    def show_graphs(
        self,
        configurations: Mapping[str, Configuration],
        about: Mapping[str, Sequence[Finding]],
        note: str,
        *,
        counted: bool,
        unstarted: Sequence[Configuration] = (),
    ) -> None:
        """Show computation graphs from now on; see the arguments of the class."""
        self._unstarted = tuple(unstarted)
        # Another thread may be looking: the new book takes the place of the old one when it is whole.
        self.__dict__["book"] = self._book_of(configurations, about, note, counted=counted)

    @cached_property
    def book(self) -> Book:
        """The configurations, with a way to the pages of their nodes and topics."""
        return self._book_of(self._configurations, self._about, self._graph_note, counted=self._graphs_counted)

    def _book_of(
        self,
        configurations: Mapping[str, Configuration],
        about: Mapping[str, Sequence[Finding]],
        note: str,
        *,
        counted: bool,
    ) -> Book:
        from roslens.dashboard.computation.book import Book
        from roslens.dashboard.computation.system import systems_of

        systems = systems_of(configurations, about)
        return Book(
            systems,
            lambda path: path in self.places,
            note,
            counted=counted,
            packages=self.by_id,
            rules=self.rules,
            unstarted=self._unstarted,
        )

    @property
    def code_marks(self) -> CodeMarks:
        """What lines of files are to the computation graphs."""
        from roslens.dashboard.computation.code_marks import CodeMarks

        book = self.book
        if self._marks is None or self._marks[0] is not book:
            self._marks = (book, CodeMarks(book))
        return self._marks[1]

    @cached_property
    def run_models(self) -> tuple[QualityModel, ...]:
        """The models that the run was judged by; the others are there to compare."""
        from roslens.judge.quality.quality_model import model_name

        names = {PurePath(model_name(name)).stem for name in self.view.header.models}
        return tuple(model for model in self.models if model.name in names)

    @cached_property
    def _constraints(self) -> dict[tuple[EntityKind, str], list[tuple[QualityModel, Constraint]]]:
        found: dict[tuple[EntityKind, str], list[tuple[QualityModel, Constraint]]] = {}
        for model in self.models:
            for constraint in model.constraints:
                found.setdefault((constraint.kind, constraint.quantity), []).append((model, constraint))
        return found

    def constraints_on(self, kind: EntityKind, quantity: str) -> Sequence[tuple[QualityModel, Constraint]]:
        """Return the limits of the models on a quantity (or a fold of it) of entities of this kind."""
        return self._constraints.get((kind, quantity), ())

    def rating(self, kind: EntityKind, quantity: str, value: float | None) -> str:
        """Return how the value stands to the run's own models: ``high``, ``low``, ``ok`` or nothing without a bound."""
        ratings = [rate(value, own) for own in self._own_ranges.get((kind, quantity), ())]
        for rating in (State.HIGH, State.LOW, State.OK):
            if rating in ratings:
                return str(rating.value)
        return ""

    @cached_property
    def _own_ranges(self) -> dict[tuple[EntityKind, str], list[Range]]:
        own = {model.name for model in self.run_models}
        return {
            about: [constraint.range for model, constraint in said if model.name in own and constraint.name == EVERY]
            for about, said in self._constraints.items()
        }

    def run_facts(self) -> dict[str, object]:
        """Return the description of the run for every JSON twin."""
        header = self.view.header
        return {
            "id": self.view.id,
            "root": header.root,
            "started": header.started,
            "commit": header.commit,
            "models": list(header.models),
        }
