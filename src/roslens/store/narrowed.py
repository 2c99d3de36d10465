"""A run of which only some findings are looked at; everything else of it is as it is."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Collection, Iterable, Iterator
from functools import cached_property

import msgspec

from roslens.model.failure import Failure
from roslens.model.finding import Finding, Severity
from roslens.model.result import PackageResult, PackageSummary, WorkspaceResult
from roslens.model.tags import TagFilter
from roslens.store.read import RunView
from roslens.store.summary import rule_counts

Keep = Callable[[Finding], bool]


class NarrowedView(RunView):
    """A run whose findings are those that ``keep`` is true of; counts of packages are counted again.

    ``failures`` come besides those of the run: what went wrong when it was looked at.
    """

    def __init__(
        self,
        view: RunView,
        keep: Keep | None = None,
        failures: Iterable[Failure] = (),
        keep_failure: Callable[[Failure], bool] | None = None,
    ) -> None:
        """Without ``keep`` all findings stay, without ``keep_failure`` all failures."""
        super().__init__(view._run, view.header)  # noqa: SLF001 - the same run
        self.keep = keep
        self.more = tuple(failures)
        self.keep_failure = keep_failure

    def _kept(self, findings: Iterable[Finding]) -> Iterator[Finding]:
        return filter(self.keep, findings) if self.keep else iter(findings)

    @cached_property
    def workspace(self) -> WorkspaceResult:
        """What only the packages together show."""
        whole = super().workspace
        return msgspec.structs.replace(
            whole,
            findings=tuple(self._kept(whole.findings)),
            package_findings={package: tuple(self._kept(own)) for package, own in whole.package_findings.items()},
        )

    def packages(self) -> tuple[PackageSummary, ...]:
        """Return the summaries of all packages."""
        summaries = super().packages()
        if self.keep is None:
            return summaries
        found: dict[str, list[Finding]] = defaultdict(list)
        for package, finding in self.owned_findings():
            found[package].append(finding)
        return tuple(msgspec.structs.replace(one, rules=rule_counts(found[one.id])) for one in summaries)

    def package(self, package: str) -> PackageResult | None:
        """Return everything known of the package with this id."""
        result = super().package(package)
        return result and msgspec.structs.replace(result, findings=tuple(self._kept(result.findings)))

    def findings(  # noqa: D102 - as the class above says
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
        found = self._kept(
            super().findings(
                package=package,
                rule=rule,
                path=path,
                include_tags=include_tags,
                exclude_tags=exclude_tags,
                tags=tags,
                severity=severity,
                worst_first=worst_first,
            )
        )
        for number, one in enumerate(found):
            if limit is not None and number >= offset + limit:
                return
            if number >= offset:
                yield one

    def owned_findings(self, tags: TagFilter | None = None) -> Iterator[tuple[str, Finding]]:
        """Yield package ids and findings with tags that match."""
        for package, finding in super().owned_findings(tags):
            if self.keep is None or self.keep(finding):
                yield package, finding

    def count_findings(  # noqa: D102 - as the class above says
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
        found = self.findings(
            package=package,
            rule=rule,
            path=path,
            include_tags=include_tags,
            exclude_tags=exclude_tags,
            tags=tags,
            severity=severity,
        )
        return sum(1 for _ in found)

    def failures(self, *, package: str | None = None) -> tuple[Failure, ...]:
        """Return what could not be done."""
        more = () if package else self.more
        return (*filter(self.keep_failure or (lambda _: True), super().failures(package=package)), *more)


def with_failures(view: RunView, failures: Iterable[Failure]) -> NarrowedView:
    """Return a run, narrowed or not, with more failures."""
    if isinstance(view, NarrowedView):
        return NarrowedView(view, view.keep, (*view.more, *failures), view.keep_failure)
    return NarrowedView(view, None, failures)
