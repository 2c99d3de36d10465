"""The page of packages: the first of very many, in every order, and all of them where they are asked for."""

from __future__ import annotations

import msgspec
import pytest
from dashboard.fake_run import FakeRun

from roslens.dashboard.pages.packages import FIRST, build
from roslens.dashboard.site import Site
from roslens.dashboard.view import Query, Request
from roslens.model.repository import FoundRepository

PACKAGES = FIRST + 40


@pytest.fixture(scope="module")
def site() -> Site:
    return FakeRun(packages=PACKAGES, findings=2 * PACKAGES, sources=False).site()


def table(site: Site, *pairs: tuple[str, str], **given: object):
    view = build(site, Request(query=Query(pairs), **given))
    assert view is not None
    return view.table("packages")


def names(found) -> list[object]:
    return [row[0].value for row in found.rows]


def test_the_first_are_shown_and_where_all_are(site: Site) -> None:
    found = table(site)
    assert (len(found.rows), found.total, found.cut) == (FIRST, PACKAGES, True)
    assert found.all is not None
    assert dict(found.all.query) == {"show": "all"}
    whole = table(site, *found.all.query)
    assert len(whole.rows) == whole.total == PACKAGES
    assert names(whole)[:FIRST] == names(found)


def test_an_order_is_that_of_all_of_them(site: Site) -> None:
    found, whole = table(site, ("sort", "-package")), table(site, ("sort", "-package"), ("show", "all"))
    assert names(found) == sorted(names(whole), reverse=True)[:FIRST]
    assert dict(found.all.query) == {"sort": "-package", "show": "all"}


def test_what_is_filtered_is_counted_whole(site: Site) -> None:
    every = names(table(site, ("show", "all")))
    needle = str(every[-1])
    assert names(table(site, ("text", needle))) == [one for one in every if needle in str(one)]


@pytest.mark.parametrize("given", [{"complete": True}, {"medium": "folder"}])
def test_twins_and_written_pages_hold_all(site: Site, given: dict[str, object]) -> None:
    assert len(table(site, **given).rows) == PACKAGES


def test_repositories_stand_under_the_heads_that_are_theirs(monkeypatch: pytest.MonkeyPatch) -> None:
    site = FakeRun(packages=4, findings=8, sources=False).site()
    first, *others = [package.id for package in site.packages]
    found = (
        FoundRepository("arm", "ws/arm", (first,), "0" * 40, "https://example.org/arm.git", "main"),
        FoundRepository("base", "ws/base", tuple(others), "1" * 40 + "+"),
    )
    monkeypatch.setattr(site.view, "header", msgspec.structs.replace(site.view.header, repositories=found))
    view = build(site, Request())
    assert view is not None
    repositories = view.table("repositories")
    rows = {row[0].value: dict(zip([one.key for one in repositories.columns], row, strict=True))
            for row in repositories.rows}  # fmt: skip
    assert rows["arm"]["loc"].value == site.by_id[first].values["loc"]
    assert [rows["arm"][key].value for key in ("version", "commit", "url")] == [
        "main", "0" * 12, "https://example.org/arm.git"
    ]  # fmt: skip
    assert [rows["base"][key].value for key in ("packages", "commit")] == [3, "1" * 12 + "+"]
