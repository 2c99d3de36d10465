"""What a search finds, and in which order."""

from __future__ import annotations

from collections import Counter
from types import ModuleType
from typing import Any

import pytest

from roslens.dashboard.pages.search import MOST, _brief, _order, build, everything
from roslens.dashboard.site import Site
from roslens.dashboard.view import Query, Request


@pytest.fixture(scope="module")
def in_two(site: Site, made_up: ModuleType) -> Site:
    """A site that shows one system twice, under two names."""
    robot = made_up.robot()
    return Site(site.view, quantities=site.quantities, configurations={"one": robot, "two": robot})


def found(site: Site, text: str) -> list[tuple[Any, Any]]:
    view = build(site, Request(query=Query((("q", text),))))
    assert view is not None
    return [(row[0].value, row[1].value) for row in view.tables[0].rows]


def test_a_name_is_found_once_however_many_graphs_have_it(in_two: Site) -> None:
    names = Counter((kind, name) for kind, name, _, ref in everything(in_two) if ref.page in {"node", "topic"})
    assert set(names.values()) == {1}
    more = {name: more for _, name, more, _ in everything(in_two)}
    assert more["/lidar"] == "in 2 launch files"


def test_packages_come_first_then_files(in_two: Site) -> None:
    package = in_two.packages[3].id
    assert found(in_two, package)[0] == ("package", package)
    kinds = [kind for kind, _ in found(in_two, package[5:9])]
    assert kinds[0] == "package"
    last_package = max(place for place, kind in enumerate(kinds) if kind == "package")
    assert "file" not in kinds or kinds.index("file") > last_package


def test_a_whole_name_is_first_whatever_it_is(in_two: Site) -> None:
    assert found(in_two, "/lidar")[0] == ("node", "/lidar")


def test_a_description_ends_with_a_word_and_says_that_more_follows() -> None:
    assert _brief("drives") == "drives"
    found = _brief("It implements the adaptive approach, " * 9)
    assert found.endswith(" …")
    assert len(found) <= 110
    assert found.removesuffix(" …").split()[-1].strip(",") in {"It", "implements", "the", "adaptive", "approach"}


def test_files_of_own_code_come_before_those_of_tests(in_two: Site) -> None:
    of_test = _order("planner", "file", "nav/test/planner.cpp", "test")
    own = _order("planner", "file", "nav/src/planner_server.cpp", "")
    assert own < of_test
    roles = {more for kind, _, more, _ in everything(in_two) if kind == "file"} - {""}
    for role in roles:
        assert all(role in name for kind, name in found(in_two, role) if kind == "file"), "a role is no name"


def test_what_is_cut_leads_to_all_of_it(in_two: Site) -> None:
    cut = build(in_two, Request(query=Query((("q", "a"),))))
    assert cut is not None
    table = cut.tables[0]
    assert (len(table.rows), table.total > MOST) == (MOST, True)
    assert table.all is not None
    every = build(in_two, Request(query=Query(table.all.query)))
    assert every is not None
    assert (len(every.tables[0].rows), every.tables[0].all) == (table.total, None)
