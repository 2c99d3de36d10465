"""Reading one complete run: what reports and pages ask, answered with SQL and loaded only as far as it is asked."""

from __future__ import annotations

import sqlite3
from collections.abc import Collection, Iterable, Iterator, Mapping
from functools import cached_property
from itertools import groupby
from operator import itemgetter
from typing import TYPE_CHECKING

import msgspec

from roslens.model.entity import Entity, EntityKind
from roslens.model.failure import Failure
from roslens.model.finding import Finding, RuleInfo, Severity
from roslens.model.process import RepositoryProcess
from roslens.model.quantity import Quantity
from roslens.model.result import PackageResult, PackageSummary, RunHeader, WorkspaceResult
from roslens.model.set_aside import SetAside
from roslens.model.source import SourceFile
from roslens.model.tags import TagFilter, tag_filter
from roslens.store import rows
from roslens.store.columns import Columns, columns_of
from roslens.store.process_values import file_values, measured_by_history, process_numbers
from roslens.store.question import Conditions, Run
from roslens.store.summary import with_share
from roslens.store.values import (
    PackageValues,
    all_numbers,
    extreme_numbers,
    named_numbers,
    with_package_values,
)

if TYPE_CHECKING:
    from roslens.model.judged_configuration import JudgedConfiguration

_decode_rules = msgspec.json.Decoder(tuple[RuleInfo, ...]).decode
_decode_quantities = msgspec.json.Decoder(tuple[Quantity, ...]).decode


class RunView:
    """One complete run.

    Everything comes in a fixed order: packages by id (files outside packages last), within a package files, entities
    and failures as analysed and findings by path, line and column, behind them those that only all packages together
    show of it in the same order; what belongs to no package comes last, under the package ``""``. Methods that return
    iterators read while they are iterated. All of them raise StoreError when the store cannot be read.
    """

    def __init__(self, run: Run, header: RunHeader) -> None:
        """Use :meth:`roslens.store.runs.Store.view`."""
        self._run = run
        self.id = run.number
        self.header = header
        self._read_last: tuple[tuple[int, str | None], Columns] | None = None

    def wait_at_most(self, seconds: float) -> None:
        """Wait no longer than so many seconds for another process that holds the store alone."""
        self._run.wait_at_most(seconds)

    @cached_property
    def workspace(self) -> WorkspaceResult:
        """What only the packages together show."""
        with self._run.reading() as connection:
            rules, quantities, unit = connection.execute(
                "SELECT vocabulary.rules, vocabulary.quantities, run.workspace "
                "FROM run JOIN vocabulary ON vocabulary.id = run.vocabulary WHERE run.id = ?",
                (self.id,),
            ).fetchone()
            package_values: dict[str, dict[str, float]] = {}
            for package, quantity, value in connection.execute(
                "SELECT package, quantity, value FROM package_value WHERE run = ? ORDER BY package, quantity",
                (self.id,),
            ):
                package_values.setdefault(package, {})[quantity] = value
            return WorkspaceResult(
                package_values=package_values,
                package_findings=self._shares(connection),
                findings=_unit_findings(connection, unit),
                failures=_unit_failures(connection, unit),
                set_aside=_unit_set_aside(connection, unit),
                process=self.process,
                rules=_decode_rules(rules),
                quantities=_decode_quantities(quantities),
            )

    def _shares(self, connection: sqlite3.Connection) -> dict[str, tuple[Finding, ...]]:
        found = connection.execute(
            "SELECT unit.package, unit.id FROM run_unit JOIN unit ON unit.id = run_unit.unit "
            "WHERE run_unit.run = ? AND unit.key IS NULL AND unit.package <> '' ORDER BY run_unit.position",
            (self.id,),
        ).fetchall()
        return {package: _unit_findings(connection, unit) for package, unit in found}

    @cached_property
    def _package_values(self) -> dict[str, Mapping[str, float]]:
        values: dict[str, dict[str, float]] = {}
        with self._run.reading() as connection:
            for package, quantity, value in connection.execute(
                "SELECT package, quantity, value FROM package_value WHERE run = ? ORDER BY package, quantity",
                (self.id,),
            ):
                values.setdefault(package, {})[quantity] = value
        return {**values, **file_values(self.process)}

    def rules(self) -> tuple[RuleInfo, ...]:
        """Return every rule that a finding of the run may name."""
        return self.workspace.rules

    def quantities(self) -> tuple[Quantity, ...]:
        """Return everything that may have been measured."""
        return self.workspace.quantities

    def packages(self) -> tuple[PackageSummary, ...]:
        """Return the summaries of all packages, with what only the packages together show among their values."""
        with self._run.reading() as connection:
            found = connection.execute(
                "SELECT unit.summary, unit.key IS NULL FROM run_unit CROSS JOIN unit ON unit.id = run_unit.unit "
                "WHERE run_unit.run = ? AND unit.package <> '' ORDER BY run_unit.position",
                (self.id,),
            ).fetchall()
        summaries: list[PackageSummary] = []
        for text, is_share in found:
            if is_share:
                summaries[-1] = with_share(summaries[-1], rows.to_summary(text))
            else:
                summaries.append(self._with_package_values(rows.to_summary(text)))
        return tuple(summaries)

    def package(self, package: str) -> PackageResult | None:
        """Return everything known of the package with this id."""
        with self._run.reading() as connection:
            found = connection.execute(
                "SELECT unit.id FROM run_unit JOIN unit ON unit.id = run_unit.unit "
                "WHERE run_unit.run = ? AND unit.package = ? AND unit.package <> '' ORDER BY run_unit.position",
                (self.id, package),
            ).fetchall()
            if not found:
                return None
            result = read_unit(connection, found[0][0], self._package_values)
            shares = [finding for unit in found[1:] for finding in _unit_findings(connection, unit[0])]
            return msgspec.structs.replace(result, findings=(*result.findings, *shares)) if shares else result

    def outline(self, package: str) -> PackageResult | None:
        """Return the package with this id, its files, includes and entities without values; no findings or failures."""
        with self._run.reading() as connection:
            found = connection.execute(
                "SELECT unit.id, unit.manifest, unit.summary FROM run_unit JOIN unit ON unit.id = run_unit.unit "
                "WHERE run_unit.run = ? AND unit.package = ? AND unit.package <> '' AND unit.manifest IS NOT NULL",
                (self.id, package),
            ).fetchone()
            if found is None:
                return None
            return PackageResult(
                rows.to_package(found[1]),
                tuple(map(rows.to_file, _of_unit(connection, rows.FILE, "file", found[0]))),
                tuple(rows.to_entity(row, {}) for row in _of_unit(connection, rows.ENTITY, "entity", found[0])),
                includes=rows.to_summary(found[2]).includes,
            )

    def files(self, *, package: str | None = None, path: str | None = None) -> Iterator[tuple[str, SourceFile]]:
        """Yield package ids and files."""
        where = Conditions()
        where.package(package)
        where.equal("file.path", path)
        for row in self._run.rows(f"unit.package, {rows.FILE}", "file", where, unit=True):
            yield row[0], rows.to_file(row[1:])

    def entities(
        self, *, package: str | None = None, kind: EntityKind | None = None, path: str | None = None
    ) -> Iterator[Entity]:
        """Yield entities with their values; packages have what only the packages together show among theirs."""
        where = Conditions()
        where.package(package)
        where.equal("entity.kind", kind.value if kind else None)
        where.equal("entity.path", path)
        yield from self._entities(where, kind)

    def entity(self, identity: str) -> Entity | None:
        """Return the entity with this id (its text form)."""
        where = Conditions()
        where.equal("entity.id", identity)
        kind, _, name = identity.partition(":")
        if kind in {EntityKind.FILE.value, EntityKind.CLASS.value, EntityKind.FUNCTION.value}:
            where.equal("entity.path", name.partition("#")[0])
        elif kind == EntityKind.PACKAGE.value:
            where.package(name)
        return next(self._entities(where, None), None)

    def _entities(self, where: Conditions, kind: EntityKind | None) -> Iterator[Entity]:
        found = self._run.rows(f"run_unit.unit, entity.position, {rows.ENTITY}", "entity", where)
        for unit, group in groupby(found, key=itemgetter(0)):
            columns = self._columns(unit, kind.value if kind else None)
            for row in group:
                values = with_package_values(row[2], columns.values(row[3], row[1]), self._package_values)
                yield rows.to_entity(row[2:], values)

    def _columns(self, unit: int, kind: str | None) -> Columns:
        # Who asks for one file of a package after the other needs the same columns each time.
        last = self._read_last
        if last is None or last[0] != (unit, kind):
            with self._run.reading() as connection:
                last = self._read_last = ((unit, kind), columns_of(connection, unit, kind))
        return last[1]

    def findings(
        self,
        *,
        package: str | None = None,
        rule: str | None = None,
        path: str | None = None,
        include_tags: Iterable[str] = (),
        exclude_tags: Iterable[str] = (),
        tags: TagFilter | None = None,
        severity: Severity | Collection[Severity] | None = None,
        limit: int | None = None,
        offset: int = 0,
        worst_first: bool = False,
    ) -> Iterator[Finding]:
        """Yield the findings that meet all conditions.

        Args:
            package: id of the package; ``""`` for what belongs to no package.
            rule: id of the rule.
            path: of the file, below the workspace root.
            include_tags: at least one of these tags, when there are any.
            exclude_tags: none of these tags.
            tags: a condition on the tags, besides the two lists.
            severity: exactly this one, or one of these.
            limit: at most so many.
            offset: without the first so many.
            worst_first: those first that count for gates, of these the gravest and surest, of these those whose value
                is furthest beyond its bound, see :attr:`Finding.excess`.
        """
        where = self._finding_conditions(package, rule, path, severity)
        known = self._tag_sets()
        where.tags(tag_filter(include_tags, exclude_tags).both(tags or TagFilter()), known)
        first = rows.WORST_FIRST if worst_first else ""
        for row in self._run.rows(rows.FINDING, "finding", where, limit=limit, offset=offset, first=first):
            yield rows.to_finding(row, known)

    def owned_findings(self, tags: TagFilter | None = None) -> Iterator[tuple[str, Finding]]:
        """Yield package ids (``""`` for none) and findings with tags that match, in the order of :meth:`findings`."""
        where = Conditions()
        known = self._tag_sets()
        where.tags(tags or TagFilter(), known)
        for row in self._run.rows(f"unit.package, {rows.FINDING}", "finding", where, unit=True):
            yield row[0], rows.to_finding(row[1:], known)

    def count_findings(
        self,
        *,
        package: str | None = None,
        rule: str | None = None,
        path: str | None = None,
        include_tags: Iterable[str] = (),
        exclude_tags: Iterable[str] = (),
        tags: TagFilter | None = None,
        severity: Severity | Collection[Severity] | None = None,
    ) -> int:
        """Return how many findings meet all conditions; see :meth:`findings`."""
        where = self._finding_conditions(package, rule, path, severity)
        where.tags(tag_filter(include_tags, exclude_tags).both(tags or TagFilter()), self._tag_sets())
        for row in self._run.rows("count(*)", "finding", where, order=""):
            return int(row[0])
        return 0

    def set_aside(self, *, path: str | None = None, tags: TagFilter | None = None) -> Iterator[SetAside]:
        """Yield the findings that were set aside, with their source and reason."""
        where = Conditions()
        where.equal("set_aside.path", path)
        wanted = tags or TagFilter()
        for row in self._run.rows(rows.SET_ASIDE, "set_aside", where):
            one = rows.to_set_aside(row)
            if wanted.matches(one.finding.tags):
                yield one

    def failures(self, *, package: str | None = None) -> tuple[Failure, ...]:
        """Return what could not be done."""
        where = Conditions()
        where.package(package)
        return tuple(rows.to_failure(row) for row in self._run.rows(rows.FAILURE, "failure", where))

    def configurations(self) -> tuple[JudgedConfiguration, ...]:
        """Return the computation graphs that the run looked at, in their order; none where it looked at none."""
        from roslens.store.configurations import read_configurations

        with self._run.reading() as connection:
            return read_configurations(connection, self.id)

    @cached_property
    def process(self) -> tuple[RepositoryProcess, ...]:
        """The histories of repositories; nothing if the run did not read them."""
        from roslens.store.process import read_process

        with self._run.reading() as connection:
            return read_process(connection, self.id)

    def measured(self, kind: EntityKind | None = None) -> tuple[str, ...]:
        """Return the keys of the quantities that entities (of one kind) have, folds included, sorted."""
        where = Conditions()
        where.equal("measured.kind", kind.value if kind else None)
        found = {row[0] for row in self._run.rows("DISTINCT measured.quantity", "measured", where, order="")}
        if kind in {None, EntityKind.PACKAGE}:
            found.update(quantity for values in self._package_values.values() for quantity in values)
        return tuple(sorted(found | measured_by_history(self.process, kind)))

    def values_of(self, quantity: str, kind: EntityKind) -> list[tuple[str, str, float]]:
        """Return entity id, package id and value of every entity of the kind that has the quantity."""
        found = named_numbers(self._run, self._package_values, quantity, kind)
        return found or process_numbers(self.process, self.files(), quantity, kind)

    def numbers_of(self, quantity: str, kind: EntityKind) -> list[float]:
        """Return every value of the quantity among entities of the kind: what a distribution needs, and quick."""
        found = all_numbers(self._run, self._package_values, quantity, kind)
        return found or [value for *_, value in process_numbers(self.process, self.files(), quantity, kind)]

    def extremes_of(
        self, quantity: str, kind: EntityKind, count: int = 20, *, highest: bool = True
    ) -> list[tuple[Entity, str, float]]:
        """Return entity, package id and value of the ``count`` highest (or lowest) values, the most extreme first."""
        found = extreme_numbers(self._run, self._package_values, quantity, kind, count, highest=highest)
        if found or not (others := process_numbers(self.process, self.files(), quantity, kind)):
            return found
        others.sort(key=lambda one: (-one[2] if highest else one[2], one[0]))
        known = ((self.entity(identity), package, value) for identity, package, value in others[:count])
        return [(entity, package, value) for entity, package, value in known if entity is not None]

    def _with_package_values(self, summary: PackageSummary) -> PackageSummary:
        more = self._package_values.get(summary.id)
        return msgspec.structs.replace(summary, values={**summary.values, **more}) if more else summary

    def _tag_sets(self) -> dict[int, tuple[str, ...]]:
        with self._run.reading() as connection:
            return _tag_sets(connection)

    def _finding_conditions(
        self, package: str | None, rule: str | None, path: str | None, severity: Severity | Collection[Severity] | None
    ) -> Conditions:
        where = Conditions()
        where.package(package)
        where.equal("finding.rule", rule)
        where.equal("finding.path", path)
        if severity is not None:
            wanted = [severity] if isinstance(severity, Severity) else severity
            where.one_of("finding.severity", [item.value for item in wanted])
        return where


def read_unit(connection: sqlite3.Connection, unit: int, package_values: PackageValues | None = None) -> PackageResult:
    """Return the package's result that the unit holds; its own entity gets its ``package_values`` too."""
    manifest, summary = connection.execute("SELECT manifest, summary FROM unit WHERE id = ?", (unit,)).fetchone()
    columns = columns_of(connection, unit)
    return PackageResult(
        package=rows.to_package(manifest),
        files=tuple(map(rows.to_file, _of_unit(connection, rows.FILE, "file", unit))),
        entities=tuple(
            rows.to_entity(row[1:], with_package_values(row[1], columns.values(row[2], row[0]), package_values or {}))
            for row in _of_unit(connection, f"position, {rows.ENTITY}", "entity", unit)
        ),
        findings=_unit_findings(connection, unit),
        failures=_unit_failures(connection, unit),
        set_aside=_unit_set_aside(connection, unit),
        includes=rows.to_summary(summary).includes,
    )


def _unit_findings(connection: sqlite3.Connection, unit: int) -> tuple[Finding, ...]:
    known = _tag_sets(connection)
    return tuple(rows.to_finding(row, known) for row in _of_unit(connection, rows.FINDING, "finding", unit))


def _unit_failures(connection: sqlite3.Connection, unit: int) -> tuple[Failure, ...]:
    return tuple(map(rows.to_failure, _of_unit(connection, rows.FAILURE, "failure", unit)))


def _unit_set_aside(connection: sqlite3.Connection, unit: int) -> tuple[SetAside, ...]:
    return tuple(map(rows.to_set_aside, _of_unit(connection, rows.SET_ASIDE, "set_aside", unit)))


def _of_unit(connection: sqlite3.Connection, columns: str, table: str, unit: int) -> sqlite3.Cursor:
    return connection.execute(f"SELECT {columns} FROM {table} WHERE unit = ? ORDER BY position", (unit,))  # noqa: S608 - names of this package


def _tag_sets(connection: sqlite3.Connection) -> dict[int, tuple[str, ...]]:
    return {number: rows.to_texts(text) for number, text in connection.execute("SELECT id, tags FROM tag_set")}
