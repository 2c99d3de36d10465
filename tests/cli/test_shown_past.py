"""Pages about the past: curves, differences, hotspots, and what the overview says; served and as files."""

import argparse
import json

import pytest
from process_metrics.small_repository import MANIFEST, SmallRepository, function

from roslens.cli.graph.site import site_of
from roslens.cli.main import main
from roslens.cli.past.shown_past import shown_past
from roslens.cli.workplace.workplace import open_store
from roslens.dashboard.address import ServedLinks
from roslens.dashboard.render import Renderer
from roslens.dashboard.routes import PAGES
from roslens.dashboard.view import Query, Request


@pytest.fixture(scope="module")
def root(tmp_path_factory):
    made = SmallRepository(tmp_path_factory.mktemp("w") / "w")
    made.commit("one", day=0, p__package_DOT_xml=MANIFEST.format("p"), p__a_DOT_cpp=function("a", 2))
    made.git("tag", "1.0.0")
    made.commit("two", day=2, p__a_DOT_cpp=function("a", 20))
    made.git("tag", "1.1.0")
    made.commit("three", day=40, p__a_DOT_cpp=function("a", 3), q__package_DOT_xml=MANIFEST.format("q"))
    assert main(["history", str(made.root), "--every", "1", "-q"]) == 0
    quiet = ["-q", "--jobs", "1", "--fail-on", "never", "-o", str(made.root / "report.json")]
    assert main(["check", str(made.root), "--process-metrics", *quiet]) == 0
    return made.root


@pytest.fixture
def site(root):
    options = argparse.Namespace(no_store=False, path=str(root))
    with open_store(str(root)) as store:
        view = store.view()
        with shown_past(options, view) as past:
            made = site_of(view)
            made.past = past
            yield made


def page(site, name: str, key: str = "", **query: str) -> tuple[str, dict]:
    view = PAGES[name](site, Request(key, Query(query.items())))
    assert view is not None
    return Renderer(site, "served").page(view, ServedLinks()), json.loads(view.to_json(site.run_facts()))


def rows(document: dict, table: str) -> list[dict]:
    return document["tables"][table]["rows"]


def test_the_overview_says_what_is_different_since_the_last_release(site):
    html, _ = page(site, "overview")
    assert "Since release <b>1.1.0</b> (2020-09-15)" in html
    assert "0 new findings, 1 resolved" in html
    assert "-17 lines of code" in html
    assert 'data-nav="history"' in html
    assert 'data-nav="hotspots"' in html


def test_history_has_curves_events_and_a_choice_of_two(site):
    html, document = page(site, "history")
    assert [point["name"] for point in document["points"]] == ["1.0.0", "1.1.0", document["points"][2]["name"]]
    assert html.count('class="distribution trend"') >= 4
    assert "<title>release: 1.1.0</title>" in html
    assert f'<option value="{document["points"][1]["commit"]}" selected>1.1.0, 2020-09-15</option>' in html
    assert len(rows(document, "revisions")) == 3


def test_a_trend_has_a_curve_a_package_and_a_table(site):
    html, document = page(site, "trend", "loc")
    assert "data-commits=" in html
    assert [list(row.values())[2] if isinstance(row, dict) else row[2] for row in rows(document, "values")] == [
        6,
        23,
        5,
    ]
    alone, _ = page(site, "trend", "loc", package="p")
    assert "<option selected>p</option>" in alone
    assert PAGES["trend"](site, Request("nothing")) is None


def test_what_only_revisions_have_keeps_its_name_and_unit_beside_a_run_of_the_files_as_they_are(tmp_path):
    made = SmallRepository(tmp_path / "w")
    made.commit("one", day=0, p__package_DOT_xml=MANIFEST.format("p"), p__a_DOT_cpp=function("a", 2))
    made.commit("two", day=2, p__a_DOT_cpp=function("a", 20))
    assert main(["history", str(made.root), "--every", "1", "-q"]) == 0
    (made.root / "p/a.cpp").write_text(function("a", 5))
    assert main(["check", str(made.root), "-q", "--jobs", "1", "--fail-on", "never", "-o", str(tmp_path / "r")]) == 0
    with open_store(str(made.root)) as store:
        view = store.view()
        with shown_past(argparse.Namespace(no_store=False, path=str(made.root)), view) as past:
            site = site_of(view)
            site.past = past
            html, document = page(site, "trend", "age")
            beside, _ = page(site, "history")
    assert (document["title"], document["unit"]) == ("Age", "d")
    assert "of the files as they are now there is no value" in html
    assert "(2020-09-13) to now (" in beside


def test_differences_in_order_of_time(site):
    first, second, third = (point.commit for point in site.past.points)
    html, document = page(site, "difference", before=first, after=second)
    assert len(rows(document, "new")) == 1
    assert "extreme.static_paths.max" in html
    turned, again = page(site, "difference", before=second, after=first)
    assert rows(again, "new") == rows(document, "new")
    assert "The later revision was given first" in turned
    _, last = page(site, "difference")
    assert (last["before"]["name"], last["after"]["commit"]) == ("1.1.0", third)
    assert last["added"] == ["q"]
    assert len(rows(last, "resolved")) == 1
    assert page(site, "difference", before="no such", after="1.0.0")[1]["after"]["name"] == "1.0.0"


def test_hotspots_have_dots_and_a_table(site):
    html, document = page(site, "hotspots")
    assert html.count("<circle") >= 1
    (row,) = rows(document, "files")
    assert row["hotspot"] == row["churn"] * row["complexity"]
    assert len(rows(document, "repositories")) == 1
    assert f"<code>{site.name}</code>" in html, "a repository that is the workspace has its name, and no dot"


def test_without_a_past(root):
    with open_store(str(root)) as store:
        made = site_of(store.view())
        assert "roslens history --every release" in page(made, "history")[0]
        assert "roslens history --every release" in page(made, "difference")[0]
        assert PAGES["trend"](made, Request("loc")) is None
        assert "Since release" not in page(made, "overview")[0]


def test_a_report_has_the_pages(root, tmp_path):
    assert main(["report", str(root), "-o", str(tmp_path / "r"), "-q", "--no-graph", "--jobs", "1"]) == 0
    for name in ("history.html", "history/loc.html", "history/loc.json", "difference.html", "hotspots.html"):
        assert (tmp_path / "r" / name).is_file(), name
    single = tmp_path / "one.html"
    assert main(["report", str(root), "--single-file", str(single), "-q", "--no-graph"]) == 0
    text = single.read_text()
    assert 'id="history"' in text
    assert 'id="hotspots"' in text
