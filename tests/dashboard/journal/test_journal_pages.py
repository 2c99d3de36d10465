"""The pages of the journal and of questions: what they show, and who may answer."""

from __future__ import annotations

import asyncio
from concurrent.futures import ThreadPoolExecutor
from urllib.parse import urlencode

import httpx
import msgspec
import pytest

from roslens.dashboard.access.person import Person, Role
from roslens.dashboard.access.policy import Access
from roslens.dashboard.journal.journal_view import PAGE, JournalView
from roslens.dashboard.journal.questions import Questions
from roslens.dashboard.journal.routes import journal_links, journal_routes
from roslens.dashboard.live.app import Facts, create_live_app
from roslens.dashboard.live.further import Further
from roslens.model.acting.reaction import ActionCall, Because, Decision
from roslens.model.entity import EntityId, EntityKind
from roslens.store.journals.journal import Journal

KEY, VIEW_KEY = "k" * 32, "v" * 32
NASTY = '<script>alert("x")</script>'
FORM = {"content-type": "application/x-www-form-urlencoded"}
OWN = {**FORM, "origin": "http://localhost"}


def decision(number=1, name="/lidar", text=""):
    action = ActionCall("restart", EntityId(EntityKind.NODE, name))
    because = (Because(f"node:{name}", f"{name} is gone", "gone", 100.0),)
    return Decision(f"r.one/{number}.1", "r.one", f"node:{name}", 0, action, 100.0, because=because, text=text)


class Client:
    """Asks the application without a server."""

    def __init__(self, app):
        self.app = app

    def request(self, method, path, **given):
        async def ask():
            transport = httpx.ASGITransport(self.app)
            async with httpx.AsyncClient(transport=transport, base_url="http://localhost") as client:
                return await client.request(method, path, **given)

        # In a thread of its own, since tests in a browser have a loop in this one.
        with ThreadPoolExecutor(1) as thread:
            return thread.submit(lambda: asyncio.run(ask())).result()

    def get(self, path):
        return self.request("GET", path)

    def post(self, path, **given):
        return self.request("POST", path, **given)


class Scene:
    def __init__(self, folder):
        self.path = folder / "journal.jsonl"
        self.now = 1000.0
        self.questions = Questions(lambda: self.now)
        view = JournalView(self.path, lambda seconds: f"{seconds:.1f}")
        routes = journal_routes(view, "rover", questions=self.questions, wall=lambda: self.now)
        holders = {KEY: Person("Ada", Role.OPERATE), VIEW_KEY: Person("Vera", Role.VIEW)}
        access = Access(holders, steady=lambda: self.now)
        app = create_live_app(lambda: b"{}", Facts(access=access, further=Further(routes, journal_links(acting=True))))
        self.client = Client(app)

    def write(self, *entries):
        with Journal(self.path) as journal:
            for what, fields in entries:
                journal.add(what, 100.0, **fields)

    def get(self, address):
        return self.client.get(address).text

    def answer(self, word="allow", key=KEY, headers=OWN, number=1):
        told = {"decision": f"r.one/{number}.1", "answer": word}
        allowed = {"authorization": f"Bearer {key}"} if key else {}
        return self.client.post("/questions", content=urlencode(told), headers={**headers, **allowed})


@pytest.fixture
def scene(tmp_path):
    return Scene(tmp_path)


def about(entity, number=1):
    return ("decided", {"decision": f"r/{number}.1", "entity": entity, "action": {"kind": "restart"}})


def test_no_journal_yet_is_said_and_no_error(scene):
    assert "cannot read the journal" in scene.get("/journal")
    assert scene.client.get("/journal.json").json()["problem"]


def test_entries_are_newest_first_and_whole(scene):
    scene.write(about("node:/lidar"), ("outcome", {"decision": "r/1.1", "result": "done", "text": "started again"}))
    text = scene.get("/journal")
    assert text.index("started again") < text.index("decided</span>")
    assert "2 entries as they were written" in text
    newest, oldest = scene.client.get("/journal.json").json()["rows"]
    assert (newest["what"], newest["entity"], newest["mark"]) == ("outcome", "node:/lidar", "ok")
    assert oldest["n"] == 0


def test_a_changed_entry_shows(scene):
    scene.write(about("node:/lidar"), about("node:/camera", 2))
    before = scene.get("/journal")
    assert "Changed after it was written" not in before
    changed = scene.path.read_text().replace("/lidar", "/radar")
    scene.path.write_text(changed)
    assert "Changed after it was written" in scene.get("/journal")


def test_it_is_filtered_by_entity_kind_and_words(scene):
    scene.write(about("node:/lidar"), ("outcome", {"decision": "r/1.1", "result": "failed"}), about("node:/camera", 2))

    def numbers(query):
        return [one["n"] for one in scene.client.get(f"/journal.json?{query}").json()["rows"]]

    assert numbers("entity=node:/lidar") == [1, 0]
    assert numbers("what=decided") == [2, 0]
    assert numbers("text=camera") == [2]
    assert numbers("entity=node:/lidar&text=camera") == []
    assert "No entry fits." in scene.get("/journal?text=zebra")


def test_older_entries_are_a_page_away(scene):
    scene.write(*(about(f"node:/n{number}", number) for number in range(PAGE + 3)))
    first = scene.get("/journal")
    assert f"before={3}" in first
    assert f"{PAGE} of {PAGE + 3} entries" in first
    assert [one["n"] for one in scene.client.get("/journal.json?before=3").json()["rows"]] == [2, 1, 0]


def test_what_is_added_shows_and_changes_the_version(scene):
    scene.write(about("node:/lidar"))
    scene.get("/journal")
    before = scene.client.get("/journal/state.json").json()
    scene.write(about("node:/camera", 2))
    assert scene.client.get("/journal/state.json").json() != before
    assert "node:/camera" in scene.get("/journal")


def test_a_journal_that_another_took_the_place_of_is_read_anew(scene):
    scene.write(about("node:/lidar"), about("node:/lidar", 2))
    scene.get("/journal")
    scene.path.rename(scene.path.with_suffix(".old"))
    scene.write(about("node:/camera"))
    assert "node:/lidar" not in scene.get("/journal")


def test_markup_is_text(scene):
    scene.write(about(f"node:{NASTY}"), ("kept", {"text": NASTY}))
    scene.questions.ask(decision(name=f"/{NASTY}", text=NASTY), 160.0)
    for address in ("/journal", "/questions", f"/journal?text={NASTY}", f"/journal?entity={NASTY}"):
        text = scene.get(address)
        assert NASTY not in text
        assert "alert(" in text
        assert text.count("<script") == 2


def test_a_question_is_shown_and_answered_once(scene):
    scene.questions.ask(decision(text="the lidar is gone"), 160.0)
    text = scene.get("/questions")
    for word in ("restart node:/lidar", "the lidar is gone", "/lidar is gone", "1 min 0 s left"):
        assert word in text
    found = scene.answer()
    assert (found.status_code, found.headers["location"]) == (303, "questions?said=allow")
    assert scene.questions.answers() == [("r.one/1.1", True, "Ada on the page (127.0.0.1)")]
    assert scene.answer("deny").status_code == 409
    assert scene.questions.answers() == []


def test_a_question_has_what_was_observed_beside_what_holds(scene):
    one = decision()
    observed = Because("topic:/scan", "/scan is low", "low", 100.0, evidence="4 messages in 1.0 s")
    scene.questions.ask(msgspec.structs.replace(one, because=(observed,)), 160.0)
    assert "/scan is low: 4 messages in 1.0 s" in scene.get("/questions")


def test_a_decision_leads_to_its_entries(scene):
    scene.write(about("node:/lidar"), ("outcome", {"decision": "r/1.1", "result": "done"}))
    text = scene.get("/journal")
    assert text.count('href="journal?text=r/1.1"') == 2


def test_a_denial_is_an_answer_too(scene):
    scene.questions.ask(decision(), 160.0)
    assert scene.answer("deny").status_code == 303
    assert scene.questions.answers() == [("r.one/1.1", False, "Ada on the page (127.0.0.1)")]


def test_what_is_withdrawn_or_late_is_asked_no_more(scene):
    scene.questions.ask(decision(1), 160.0)
    scene.questions.ask(decision(2), 160.0)
    scene.questions.withdraw("r.one/1.1")
    assert scene.answer(number=1).status_code == 409
    scene.now += 61.0
    assert scene.answer(number=2).status_code == 409
    assert scene.questions.answers() == []


@pytest.mark.parametrize("key", ["", VIEW_KEY, "x", KEY + "k"])
def test_only_who_may_operate_answers(scene, key):
    scene.questions.ask(decision(), 160.0)
    assert scene.answer(key=key).status_code in (401, 403)
    assert scene.questions.answers() == []
    assert len(scene.questions.open()) == 1


@pytest.mark.parametrize("origin", ["http://evil.example", "null", "http://localhost:81"])
def test_only_a_page_of_this_server_answers(scene, origin):
    scene.questions.ask(decision(), 160.0)
    assert scene.answer(headers={**FORM, "origin": origin}).status_code == 403
    assert scene.answer(headers={**OWN, "sec-fetch-site": "cross-site"}).status_code == 403
    assert scene.questions.answers() == []


def test_a_form_of_this_server_answers_though_it_sends_no_referrer(scene):
    scene.questions.ask(decision(), 160.0)
    assert scene.answer(headers={**FORM, "origin": "null", "sec-fetch-site": "same-origin"}).status_code == 303


@pytest.mark.parametrize(
    ("method", "content", "headers", "status"),
    [
        ("PUT", b"", OWN, 405),
        ("POST", b"{}", {**OWN, "content-type": "application/json"}, 415),
        ("POST", b"answer=perhaps&decision=r.one/1.1", OWN, 400),
        ("POST", b"\xff\xfe=%zz&&&=", OWN, 400),
        ("POST", b"answer=allow&decision=" + b"a" * 60_000, OWN, 409),
        ("POST", b"answer=allow&decision=r.one/1.1&" + b"a" * 70_000, OWN, 413),
        ("POST", b"answer=allow&decision=r.one/1.1", {**OWN, "host": "evil.example"}, 421),
    ],
)
def test_what_is_no_answer_is_none(scene, method, content, headers, status):
    scene.questions.ask(decision(), 160.0)
    allowed = {**headers, "authorization": f"Bearer {KEY}"}
    assert scene.client.request(method, "/questions", content=content, headers=allowed).status_code == status
    assert scene.questions.answers() == []


def test_who_may_view_sees_questions_and_no_buttons(scene):
    scene.questions.ask(decision(), 160.0)
    text = scene.get("/questions")
    assert "restart node:/lidar" in text
    assert "<button name" not in text
    assert "token of the role operate" in text
    seen = scene.client.request("GET", "/questions", headers={"authorization": f"Bearer {KEY}"}).text
    assert "You answer as <b><bdi>Ada" in seen
    assert seen.count("<button name") == 2


def test_without_questions_there_is_no_page_for_them(tmp_path):
    view = JournalView(tmp_path / "journal.jsonl", str)
    further = Further(journal_routes(view, "rover"), journal_links(acting=False))
    access = Access({KEY: Person("Ada", Role.OPERATE)})
    client = Client(create_live_app(lambda: b"{}", Facts(access=access, further=further)))
    assert client.post("/questions", headers={**OWN, "authorization": f"Bearer {KEY}"}).status_code == 404
    assert 'href="questions"' not in client.get("/journal").text
