"""Names from outside on every page beside the live one: they are text, whatever they hold."""

from __future__ import annotations

import re
from urllib.parse import quote, unquote

import pytest
from dashboard.journal.test_journal_pages import Client
from dashboard.live.test_app import HOSTILE, hostile_robot

from roslens.dashboard.journal.journal_view import JournalView
from roslens.dashboard.journal.routes import journal_links, journal_routes
from roslens.dashboard.live.further import Further
from roslens.dashboard.server import create_app
from roslens.judge.reading.read_reference import GivenText, load_reference
from roslens.live.window.signals import BY_KEY
from roslens.store.journals.journal import Journal
from roslens.store.runs import StoredRun

REACTION = """
kind: reference
name: hostile
reactions:
  - id: one
    when: {node: "/<img src=x onerror=alert(1)>", is: gone}
    text: "</script><script>alert(3)</script>"
    do: [{notify: "<b>{entity}</b>"}]
"""
PAGES = (
    "/live/", "/live/references", "/live/compared?from=3&to=10", "/plan", "/journal", "/runs",
    "/search?q=%3Cscript%3Ealert(1)%3C/script%3E",
)  # fmt: skip
RIGHT_TO_LEFT = "\u202e"


@pytest.fixture(scope="module")
def client(site, tmp_path_factory):
    robot = hostile_robot()
    robot.cpu = dict.fromkeys(HOSTILE, 99.0)
    robot.run(5)
    page = robot.page
    path = tmp_path_factory.mktemp("hostile") / "journal.jsonl"
    reactions = load_reference([GivenText("r.yaml", REACTION.encode())], BY_KEY).reactions
    with Journal(path) as journal:
        for number, name in enumerate(HOSTILE):
            journal.add("decided", 1.0, decision=f"hostile.one/{number}.1", entity=f"host:{name}", text=name)
    routes = journal_routes(JournalView(path, str), HOSTILE[0], reactions=lambda: reactions)
    header = site.view.header
    before = site.runs
    site.runs = tuple(StoredRun(number, header, 8, 90, 500, 70, 0) for number in (1, 2))
    yield Client(
        create_app(
            site, snapshot=page.newest, detail=page.detail, graph=page.graph, past=page.past, board=page.board,
            further=Further(routes, journal_links(acting=False, base="/")),
        )
    )  # fmt: skip
    site.runs = before


@pytest.mark.parametrize("path", PAGES)
def test_no_name_becomes_markup(client, path):
    answer = client.get(path)
    assert answer.status_code == 200
    for one in ("<script>alert", "<img src=x", "<b>{"):
        assert one not in answer.text
    assert len(answer.text) < 3_000_000


@pytest.mark.parametrize("path", PAGES)
def test_what_turns_the_direction_of_text_turns_its_own_alone(client, path):
    # A text of a picture is a paragraph of its own.
    text = re.sub(r"(?s)<script.*?</script>|<svg.*?</svg>", "", client.get(path).text)
    alone = re.sub(r"(?s)<bdi[^>]*>.*?</bdi>|<option.*?</option>", "", text)
    outside = re.sub(r"<[^>]*>", "", alone)
    assert RIGHT_TO_LEFT not in outside


@pytest.mark.parametrize("name", HOSTILE)
def test_a_name_leads_to_its_row_or_to_a_search_and_nowhere_else(client, name):
    answer = client.get("/entity?id=" + quote(f"host:{name}"))
    assert answer.status_code == 303
    to = answer.headers["location"]
    assert to.startswith("/live/?select=")
    assert "\n" not in to
    assert unquote(to.partition("=")[2].replace("+", " ")) == f"host:{name}"
    assert client.get(to).status_code == 200
