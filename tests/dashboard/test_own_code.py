"""Amounts per line of code: findings of own code over lines of own code."""

import pytest

from roslens.dashboard.graph_model import Colouring, colour_values
from roslens.dashboard.pages.graph import build as graph_page
from roslens.dashboard.pages.packages import packages_table
from roslens.dashboard.view import Query, Request
from roslens.model.entity import EntityKind
from roslens.model.source import Role
from roslens.model.tags import TagFilter, tag_filter


def rate(site, package, tags=()):
    """Return what is worked out from findings and files one by one."""
    wanted = tag_filter(tags, ())
    roles = {file.path: file.role for _, file in site.view.files(package=package)}
    own = [
        finding
        for finding in site.view.findings(package=package, tags=wanted)
        if roles.get(finding.path, Role.OWN) is Role.OWN
    ]
    (entity,) = site.view.entities(package=package, kind=EntityKind.PACKAGE)
    return 1000 * len(own) / entity.values["loc"] if entity.values.get("loc") else None


@pytest.mark.parametrize("tags", [(), ("complexity",), ("style",)])
def test_findings_per_kloc_divide_own_by_own(site, tags):
    wanted = tag_filter(tags, ())
    expected = [rate(site, package.id, tags) for package in site.packages]
    assert any(expected)
    assert colour_values(site, Colouring("kloc", wanted))[0] == expected
    assert colour_values(site, Colouring("kloc", wanted, gated=True))[0] == expected
    table = packages_table(site, tags=wanted)
    place = [column.key for column in table.columns].index("per_kloc")
    assert [row[place].value for row in table.rows] == expected


def test_that_is_another_number_than_of_all_findings(site):
    of_all = [
        1000 * site.view.count_findings(package=package.id) / package.values["loc"]
        if package.values.get("loc")
        else None
        for package in site.packages
    ]
    found = colour_values(site, Colouring("kloc", TagFilter()))[0]
    assert any(one < all_ for one, all_ in zip(found, of_all, strict=True) if one is not None)


@pytest.mark.parametrize(
    ("query", "told"),
    [
        ({"colour": "metric:loc"}, False),
        ({"colour": "metric:loc", "include": "style"}, True),
        ({"colour": "metric:loc", "aside": "1"}, True),
        ({"include": "style"}, False),
    ],
)
def test_a_metric_says_that_tags_do_not_colour_it(site, query, told):
    view = graph_page(site, Request(query=Query(query.items())))
    assert view.shown["unfiltered"] is told
