"""Lists of findings: filtered by the address, grouped by rule or by file, each with its excerpt."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from itertools import islice

import msgspec

from roslens.dashboard.address import PageRef
from roslens.dashboard.review import Reviewed
from roslens.dashboard.site import Site
from roslens.dashboard.sources.source_text import Excerpt
from roslens.dashboard.totals import RuleTotal
from roslens.dashboard.view import Query, Request
from roslens.model.finding import Finding, Severity
from roslens.model.source import Role
from roslens.model.tags import TagFilter, tag_filter
from roslens.model.weight.consequence import Consequence
from roslens.report.run.finding_text import weight_of
from roslens.report.run.fix_first import Gravity, gravity

GROUPINGS = ("rule", "file", "function")
STATUSES = ("new", "old")
"""Against the run before; what does not count for gates is neither."""
GATES = {"gated": True, "aside": False}
"""Besides roles of files: what counts for gates, and what does not."""


class FindingFilter(msgspec.Struct, frozen=True):
    """Which findings are meant and how they are grouped; empty fields do not filter.

    A finding is meant when it has at least one of ``include`` (if there are any) and none of ``exclude``; ``without``
    are rules that are left out, ``status`` is new or old against the run before.
    """

    package: str | None = None
    rule: str = ""
    path: str = ""
    severity: Severity | None = None
    include: tuple[str, ...] = ()
    exclude: tuple[str, ...] = ()
    text: str = ""
    role: str = ""
    group: str = "rule"
    without: tuple[str, ...] = ()
    status: str = ""
    consequence: Consequence | None = None

    @property
    def tags(self) -> TagFilter:
        """The condition on tags."""
        return tag_filter(self.include, self.exclude)

    @property
    def active(self) -> bool:
        """Whether the reader has filtered, over and above what the page itself is about."""
        return bool(
            self.severity
            or self.consequence
            or self.include
            or self.exclude
            or self.text
            or self.role
            or self.without
            or self.status
        )

    def facts(self) -> dict[str, object]:
        """Return the filter for a JSON twin."""
        return msgspec.to_builtins(self)  # type: ignore[no-any-return]


class ShownFinding(msgspec.Struct, frozen=True):
    """A finding with what a reader needs besides it; ``weight`` is its consequence and certainty in words."""

    finding: Finding
    package: str
    role: str
    excerpt: Excerpt | None
    ref: PageRef | None
    is_new: bool = False
    reviewed: Reviewed | None = None
    weight: str = ""


class FindingGroup(msgspec.Struct, frozen=True):
    """Findings of one rule and severity, of one file, or of one function.

    Attributes:
        key: of what they are.
        total: how many there are.
        own: how many of them count for gates.
        findings: those that are shown.
        severity: of all of them; empty where they have several.
        more: shows all of them.
    """

    key: str
    total: int
    own: int
    findings: tuple[ShownFinding, ...]
    severity: str = ""
    more: PageRef | None = None


class FindingList(msgspec.Struct, frozen=True):
    """What a page lists: ``total`` findings in ``group_total`` groups match, those from ``start`` on are shown.

    ``own`` of them count for gates: the number that every other page calls findings.
    """

    filter: FindingFilter
    groups: tuple[FindingGroup, ...]
    total: int
    group_total: int
    own: int
    start: int = 0
    step: int = 0

    @property
    def shown(self) -> int:
        """How many are listed."""
        return sum(len(group.findings) for group in self.groups)

    def facts(self) -> dict[str, object]:
        """Return the list for a JSON twin."""
        found = [
            {**msgspec.to_builtins(shown.finding), "package": shown.package, "role": shown.role}
            for group in self.groups
            for shown in group.findings
        ]
        return {
            "filter": self.filter.facts(),
            "total": self.total,
            "own": self.own,
            "groups": self.group_total,
            "start": self.start,
            "findings": found,
        }


def filter_of(
    query: Query, *, package: str | None = None, rule: str = "", path: str = "", group: str = "rule"
) -> FindingFilter:
    """Read a filter from an address; what the page is about cannot be overridden. Unknown words do not filter."""
    severities = {severity.value: severity for severity in Severity}
    consequences = {consequence.value: consequence for consequence in Consequence}
    roles = {role.value for role in Role}
    wanted = query.get("group")
    return FindingFilter(
        package=package if package is not None else (query.get("package") or None),
        rule=rule or query.get("rule"),
        path=path or query.get("path"),
        severity=severities.get(query.get("severity")),
        include=query.all("include"),
        exclude=query.all("exclude"),
        text=query.get("text").strip(),
        role=query.get("role") if query.get("role") in {*roles, *GATES} else "",
        group=wanted if wanted in GROUPINGS else group,
        without=query.all("without"),
        status=query.get("status") if query.get("status") in STATUSES else "",
        consequence=consequences.get(query.get("consequence")),
    )


def select(site: Site, wanted: FindingFilter) -> Iterator[Finding]:
    """Return the findings meant, by package, path and line."""
    found = site.view.findings(
        package=wanted.package,
        rule=wanted.rule or None,
        path=wanted.path or None,
        tags=wanted.tags,
        severity=wanted.severity,
    )
    needle = wanted.text.casefold()
    return (one for one in found if _is_meant(site, one, wanted) and (not needle or needle in _text_of(one)))


def _is_meant(site: Site, finding: Finding, wanted: FindingFilter) -> bool:
    return (
        finding.rule not in wanted.without
        and (not wanted.consequence or finding.weight[0] is wanted.consequence)
        and (not wanted.status or _has_status(site, finding, wanted.status))
        and (not wanted.role or _is_of(site, finding, wanted.role))
    )


def _text_of(finding: Finding) -> str:
    return f"{finding.message}\n{finding.path}\n{finding.rule}\n{finding.entity}".casefold()


def _has_status(site: Site, finding: Finding, status: str) -> bool:
    since = site.since
    return since is not None and finding.gated and since.is_new(finding) is (status == "new")


def _is_of(site: Site, finding: Finding, role: str) -> bool:
    return finding.gated is GATES[role] if role in GATES else role_of(site, finding) == role


def role_of(site: Site, finding: Finding) -> str:
    """Return the role of the file; findings about a whole package count as its own code."""
    place = site.places.get(finding.path)
    return place.file.role.value if place else Role.OWN.value


def package_of(site: Site, finding: Finding) -> str:
    """Return the id of the package; empty for a finding about the workspace."""
    place = site.places.get(finding.path)
    if place:
        return place.package
    if owner := site.shared_findings.get((finding.rule, finding.path, finding.fingerprint)):
        return owner
    kind, _, name = finding.entity.partition(":")
    return name if kind == "package" and name in site.by_id else ""


def list_findings(site: Site, wanted: FindingFilter, request: Request) -> FindingList:
    """Return the list that the page shows, cut to the limits of the request."""
    start = request.query.number("start")
    if wanted.group == "file":
        return _by_file(site, wanted, request, start)
    if wanted.group == "function":
        return _by_function(site, wanted, request, start)
    if wanted.rule or wanted.path or wanted.text or wanted.role or wanted.status or wanted.consequence:
        return _scanned(site, wanted, request, start)
    return _by_rule(site, wanted, request, start)


def _by_rule(site: Site, wanted: FindingFilter, request: Request, start: int) -> FindingList:
    """Group by rule with the counts of the summaries, so that only what is shown is read."""
    severities = frozenset({wanted.severity}) if wanted.severity else frozenset[Severity]()
    every = site.rule_totals(package=wanted.package, tags=wanted.tags, severities=severities)
    totals = [one for one in every if one.rule not in wanted.without]
    limits = request.limits
    room = limits.findings
    groups = []
    for total in totals[start : start + limits.groups]:
        count = min(limits.per_group, room) if len(totals) > 1 else room
        found = site.view.findings(
            package=wanted.package,
            rule=total.rule,
            tags=wanted.tags,
            severity=total.severity,
            limit=count,
            worst_first=True,
        )
        shown = _shown(site, found, request)
        room -= len(shown)
        more = _more(request, wanted, total, len(shown))
        groups.append(FindingGroup(total.rule, total.count, total.gated, shown, total.severity.value, more))
        if room <= 0:
            break
    step = len(groups) if start + len(groups) < len(totals) else 0
    count, own = sum(total.count for total in totals), sum(total.gated for total in totals)
    return FindingList(wanted, tuple(groups), count, len(totals), own, start, step)


def _more(request: Request, wanted: FindingFilter, total: RuleTotal, shown: int) -> PageRef | None:
    if shown >= total.count:
        return None
    # A rule may have findings of several severities: each is a group of its own.
    severity = total.severity.value
    query = request.query.replaced(rule=total.rule, package=wanted.package or "", severity=severity, start="")
    return PageRef("findings", query=query)


def _scanned(site: Site, wanted: FindingFilter, request: Request, start: int) -> FindingList:
    by_rule: dict[tuple[Severity, str], list[Finding]] = {}
    total = own = 0
    for finding in select(site, wanted):
        total += 1
        own += finding.gated
        by_rule.setdefault((finding.severity, finding.rule), []).append(finding)
    gated = {key: sum(one.gated for one in found) for key, found in by_rule.items()}
    gravest = {key: min(map(gravity, found)) for key, found in by_rule.items()}
    keys = sorted(by_rule, key=lambda key: (gravest[key], -gated[key], -len(by_rule[key]), key[1]))
    ordered = [finding for key in keys for finding in sorted(by_rule[key], key=_gravest_first)]
    page = ordered[start : start + request.limits.findings]
    shown: dict[tuple[Severity, str], list[ShownFinding]] = {}
    for one in _shown(site, page, request):
        shown.setdefault((one.finding.severity, one.finding.rule), []).append(one)
    groups = tuple(
        FindingGroup(key[1], len(by_rule[key]), gated[key], tuple(found), found[0].finding.severity.value)
        for key, found in shown.items()
    )
    step = len(page) if start + len(page) < total else 0
    return FindingList(wanted, groups, total, len(by_rule), own, start, step)


def _by_file(site: Site, wanted: FindingFilter, request: Request, start: int) -> FindingList:
    counts: Counter[str] = Counter()
    gated: Counter[str] = Counter()
    page: list[Finding] = []
    total = own = 0
    for finding in select(site, wanted):
        own += finding.gated
        if start <= total < start + request.limits.findings:
            page.append(finding)
        total += 1
        counts[finding.path] += 1
        gated[finding.path] += finding.gated
    shown: dict[str, list[ShownFinding]] = {}
    for one in _shown(site, page, request):
        shown.setdefault(one.finding.path, []).append(one)
    groups = tuple(FindingGroup(path, counts[path], gated[path], tuple(found)) for path, found in shown.items())
    step = len(page) if start + len(page) < total else 0
    return FindingList(wanted, groups, total, len(counts), own, start, step)


def _by_function(site: Site, wanted: FindingFilter, request: Request, start: int) -> FindingList:
    """Group by what is at fault, a function, class or file: what breaks most rules first, then what breaks one most."""
    members: dict[str, list[Finding]] = {}
    total = own = 0
    for finding in select(site, wanted):
        total += 1
        own += finding.gated
        members.setdefault(finding.entity or f"file:{finding.path}", []).append(finding)
    keys = sorted(members, key=lambda key: _weight(key, members[key]))
    groups, room = [], request.limits.findings
    for key in keys[start:]:
        if room <= 0:
            break
        ordered = sorted(members[key], key=_gravest_first)
        shown = _shown(site, ordered[:room], request)
        room -= len(shown)
        groups.append(FindingGroup(key, len(ordered), sum(one.gated for one in ordered), shown))
    step = len(groups) if start + len(groups) < len(keys) else 0
    return FindingList(wanted, tuple(groups), total, len(keys), own, start, step)


def _gravest_first(one: Finding) -> tuple[bool, Gravity, float]:
    return not one.gated, gravity(one), -one.excess


def _weight(key: str, found: Sequence[Finding]) -> tuple[bool, Gravity, int, float, str]:
    gated = [one for one in found if one.gated]
    worst = min(map(gravity, gated or found))
    rules = len({one.rule for one in gated})
    return not gated, worst, -rules, -max((one.excess for one in gated), default=0.0), key


def _shown(site: Site, found: Iterable[Finding], request: Request) -> tuple[ShownFinding, ...]:
    limits = request.limits
    reviewed = site.review.entries() if site.review is not None else {}
    return tuple(
        ShownFinding(
            finding,
            package_of(site, finding),
            role_of(site, finding),
            site.sources.excerpt(finding.path, finding.line, finding.end_line) if limits.excerpts else None,
            file_ref(site, finding.path, finding.line),
            site.since is not None and finding.gated and site.since.is_new(finding),
            reviewed.get(finding.fingerprint),
            weight_of(finding.weight, site.rules.get(finding.rule)),
        )
        for finding in islice(found, limits.findings)
    )


def file_ref(site: Site, path: str, line: int = 0) -> PageRef | None:
    """Return the reference to a file's page, at a line; None for a file that is not part of the run."""
    if path not in site.places:
        return None
    return PageRef("file", path, anchor=f"L{line}" if line else "")
