"""Lists of findings: what the address asks for, grouped, cut, with true totals."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable

import msgspec
import pytest

from roslens.dashboard.site import Site
from roslens.dashboard.tables import finding_list
from roslens.dashboard.tables.finding_list import FindingList, filter_of, list_findings, role_of, select
from roslens.dashboard.view import Limits, Query, Request
from roslens.model.finding import Finding, Severity
from roslens.model.weight.consequence import Consequence
from roslens.report.run.fix_first import gravity

Listed = Callable[..., FindingList]


@pytest.fixture
def listed(site: Site) -> Listed:
    def of(limits: Limits | None = None, **query: str) -> FindingList:
        asked = Query(query.items())
        return list_findings(site, filter_of(asked), Request(query=asked, limits=limits or Limits()))

    return of


def everything(site: Site) -> list[Finding]:
    return list(site.view.findings())


def test_unknown_words_do_not_filter() -> None:
    wanted = filter_of(Query([("severity", "fatal"), ("consequence", "fire"), ("role", "mine"), ("group", "colour")]))
    assert wanted.severity is None
    assert wanted.consequence is None
    assert (wanted.role, wanted.group) == ("", "rule")
    assert not wanted.active


def test_what_the_page_is_about_cannot_be_overridden() -> None:
    assert filter_of(Query([("rule", "other")]), rule="this").rule == "this"
    assert filter_of(Query([("package", "other")]), package="this").package == "this"


@pytest.mark.parametrize(
    ("query", "meant"),
    [
        ({"severity": "warning"}, lambda found, _: found.severity is Severity.WARNING),
        (
            {"consequence": "may be wrong at run time"},
            lambda found, _: found.weight[0] is Consequence.MAY_BE_WRONG,
        ),
        ({"include": "cpp,ros"}, lambda found, _: {"cpp", "ros"} & set(found.tags)),
        (
            {"include": "ROS", "exclude": "metrics"},
            lambda found, _: "ros" in found.tags and "metrics" not in found.tags,
        ),
        ({"role": "test"}, lambda found, role: role == "test"),
        (
            {"text": "NAME"},
            lambda found, _: "name" in f"{found.message} {found.path} {found.rule} {found.entity}".lower(),
        ),
        ({"rule": "ros.calls.max"}, lambda found, _: found.rule == "ros.calls.max"),
    ],
)
@pytest.mark.parametrize("group", ["rule", "file"])
def test_exactly_what_is_meant_is_counted_and_selected(
    site: Site, listed: Listed, query: dict[str, str], meant: Callable[[Finding, str], object], group: str
) -> None:
    expected = [found for found in everything(site) if meant(found, role_of(site, found))]
    assert 0 < len(expected) < len(everything(site))
    assert listed(group=group, **query).total == len(expected)
    selected = select(site, filter_of(Query(query.items())))
    assert sorted(found.fingerprint for found in selected) == sorted(found.fingerprint for found in expected)


def test_groups_by_rule_come_gravest_first_and_say_how_many_there_are(site: Site, listed: Listed) -> None:
    found = listed()
    assert found.total == len(everything(site))
    order = [gravity(group.findings[0].finding) for group in found.groups]
    assert order == sorted(order)
    assert order[0][0] < order[-1][0], "limits of metrics come last"
    for group in found.groups:
        assert group.total == sum(one.rule == group.key for one in everything(site))
        assert {shown.finding.rule for shown in group.findings} == {group.key}
        assert (group.more is not None) == (len(group.findings) < group.total)


def test_findings_of_a_rule_with_several_severities_are_groups_that_are_counted_apart(
    site: Site, monkeypatch: pytest.MonkeyPatch
) -> None:
    rule = "ros.calls.max"
    turned = [
        msgspec.structs.replace(one, severity=Severity.NOTE if one.path.endswith("1.cpp") else Severity.ERROR)
        for one in everything(site)
        if one.rule == rule
    ]
    monkeypatch.setattr(finding_list, "select", lambda *_: iter(turned))
    asked = Query({"text": "e"}.items())
    found = list_findings(site, filter_of(asked), Request(query=asked, limits=Limits()))
    counts = Counter((one.severity.value, one.gated) for one in turned)
    assert [(group.key, group.severity, group.total, group.own) for group in found.groups] == [
        (rule, word, counts[word, True] + counts[word, False], counts[word, True]) for word in ("error", "note")
    ]


def test_a_group_leads_to_as_many_as_it_counts(site: Site, listed: Listed) -> None:
    for group in listed(Limits(per_group=1)).groups:
        query = dict(group.more.query) if group.more else {"rule": group.key, "severity": group.severity}
        found = listed(**query)
        assert (found.total, found.own) == (group.total, group.own)


def test_each_finding_says_its_consequence_and_how_certain_that_is(listed: Listed) -> None:
    shown = [shown for group in listed(group="file").groups for shown in group.findings]
    assert shown
    for one in shown:
        consequence, certainty = one.weight.split(", ")
        assert consequence == one.finding.weight[0].value
        assert certainty in {one.finding.weight[1].value, "unproven"}


def test_groups_by_file_hold_what_is_in_the_file(site: Site, listed: Listed) -> None:
    for group in listed(group="file").groups:
        assert {shown.finding.path for shown in group.findings} == {group.key}


@pytest.mark.parametrize("query", [{"group": "file"}, {"text": "o"}, {}])
def test_pages_lead_from_the_first_to_the_last(listed: Listed, query: dict[str, str]) -> None:
    limits = Limits(findings=23, per_group=23, groups=3)
    start, seen = 0, 0
    while True:
        found = listed(limits, start=str(start), **query)
        assert found.shown <= 23
        seen += found.shown
        if not found.step:
            break
        start += found.step
    if query:
        assert seen == found.total
    else:
        assert start < found.group_total


def test_findings_carry_their_excerpt_and_their_place(listed: Listed) -> None:
    shown = next(
        shown for group in listed(severity="warning").groups for shown in group.findings if shown.finding.line > 2
    )
    assert shown.excerpt is not None
    assert any(hit for _, hit, _ in shown.excerpt.lines)
    assert shown.ref is not None
    assert (shown.ref.key, shown.ref.anchor) == (shown.finding.path, f"L{shown.finding.line}")


def test_findings_of_a_rule_are_listed_by_how_far_they_are_beyond(site: Site) -> None:
    for query in ({}, {"rule": "ros.calls.max"}):
        found = list_findings(site, filter_of(Query(query.items())), Request(query=Query(query.items())))
        for group in found.groups:
            order = [(shown.finding.gated, shown.finding.excess) for shown in group.findings]
            assert order == sorted(order, reverse=True), "own code first, then how far it is beyond"
    assert any(shown.finding.excess > 1 for shown in group.findings)
