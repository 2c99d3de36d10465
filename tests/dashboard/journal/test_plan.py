"""The plan and the journal as pages of a site: what is to be done, and what became of it."""

from __future__ import annotations

import re

import pytest
from dashboard.journal.test_journal_pages import NASTY, Client

from roslens.dashboard.journal.journal_view import JournalView
from roslens.dashboard.journal.routes import journal_links, journal_routes
from roslens.dashboard.live.further import Further
from roslens.dashboard.server import create_app
from roslens.judge.reading.read_reference import GivenText, load_reference
from roslens.live.window.signals import BY_KEY
from roslens.report.history.journal_text import action_text
from roslens.store.journals.journal import Journal

REFERENCE = """
kind: reference
name: rover
reactions:
  - id: lidar
    when: {node: /lidar, is: [gone, stopped]}
    unless: {host: base, is: absent}
    cool_down: 10 s
    mode: ask
    text: "%s"
    do:
      - notify: "{entity} is started again"
      - restart: {node: /lidar}
        verify: 15 s
  - id: quiet
    when: {topic: /scan, is: absent}
    do: [{snapshot: {}}]
"""


@pytest.fixture
def shown(site, tmp_path):
    path = tmp_path / "journal.jsonl"
    reference = load_reference([GivenText("r.yaml", (REFERENCE % NASTY.replace('"', '\\"')).encode())], BY_KEY)
    routes = journal_routes(
        JournalView(path, lambda seconds: f"{seconds:.1f}"), "rover", reactions=lambda: reference.reactions
    )
    return Client(create_app(site, further=Further(routes, journal_links(acting=False, base="/")))), path


def test_a_site_leads_to_both_and_back(shown):
    client, _ = shown
    assert '<a href="/plan">Countermeasures</a>' in client.get("/").text
    page = client.get("/plan").text
    assert '<a href="/plan" aria-current="page">Countermeasures</a>' in page
    assert '<a href="/packages">Packages</a>' in page
    for one in set(re.findall(r'(?:src|href)="([^"#]+)"', page)):
        assert client.get(one if one.startswith("/") else f"/{one}").status_code == 200, one


def test_each_countermeasure_is_said_in_words(shown):
    client, _ = shown
    first, second = client.get("/plan.json").json()
    assert (first["name"], first["when"]) == ("rover.lidar", "node /lidar is gone or stopped")
    assert first["steps"][1] == "restart node:/lidar; if that does not help within 15 s, it is given up"
    assert "not while host base is absent" in first["limits"]
    assert first["mode"] == "ask"
    assert second["when"] == "topic /scan is absent"
    page = client.get("/plan").text
    assert NASTY not in page
    assert "No decision yet." in page
    assert "needs approval" in page


def test_what_became_of_it_stands_beside(shown):
    client, path = shown
    with Journal(path) as journal:
        journal.add("decided", 100.0, decision="rover.lidar/1.1", entity="node:/lidar", action={"kind": "restart"})
        journal.add("done", 101.0, decision="rover.lidar/1.1", result="done")
        journal.add("decided", 102.0, decision="rover.lidar/2.1", entity="node:/lidar", action={"kind": "restart"})
        journal.add("done", 103.0, decision="rover.lidar/2.1", result="failed", text="no allow-list")
    first, second = client.get("/plan.json").json()
    assert first["decided"] == 2
    assert first["last"]["text"] == "failed, no allow-list"
    assert first["last"]["mark"] == "warning"
    assert "last" not in second
    assert '<a href="journal?text=rover.lidar">2 decisions</a>' in client.get("/plan").text


def test_without_reactions_it_says_where_they_are_written(site, tmp_path):
    routes = journal_routes(JournalView(tmp_path / "j", str), "rover")
    client = Client(create_app(site, further=Further(routes, journal_links(acting=False, base="/"))))
    assert "The reference has no <code>reactions:</code>" in client.get("/plan").text
    assert "cannot read the journal" in client.get("/journal").text


def test_without_a_reference_nothing_is_said_of_one(site, tmp_path):
    (tmp_path / "j").write_text("")
    routes = journal_routes(JournalView(tmp_path / "j", str), "rover", reactions=lambda: None)
    client = Client(create_app(site, further=Further(routes, journal_links(acting=False, base="/"))))
    page = client.get("/plan").text
    assert "No reference was given" in page
    assert "The reference has" not in page
    assert "Nothing has been decided or done yet." in client.get("/journal").text


def test_who_reacts_now_is_led_to(shown):
    client, path = shown
    lead = '<a href="http://127.0.0.1:8123/questions">'
    with Journal(path) as journal:
        journal.add("began", 100.0, mode="ask", page="http://127.0.0.1:8123/")
    assert lead in client.get("/plan").text
    assert lead in client.get("/journal").text
    with Journal(path) as journal:
        journal.add("ended", 101.0, text="nothing is done any more")
    assert lead not in client.get("/plan").text


@pytest.mark.parametrize("page", ["javascript:alert(1)", "", None, 7])
def test_what_is_no_address_leads_nowhere(shown, page):
    client, path = shown
    with Journal(path) as journal:
        journal.add("began", 100.0, mode="ask", page=page)
    assert "What is asked before it is done" not in client.get("/plan").text


def test_durations_have_their_unit():
    action = {"kind": "restart", "target": "node:/lidar", "arguments": {"grace": 1.0, "whole_process": True}}
    assert action_text(action) == "restart node:/lidar (grace: 1 s, whole_process: true)"
    assert action_text({"kind": "unheard of", "arguments": {"grace": 1.0}}) == "unheard of (grace: 1.0)"
