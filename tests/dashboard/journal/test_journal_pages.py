"""The pages of the journal and of questions: what they show, and who may answer."""

from __future__ import annotations

import asyncio
import time
from concurrent.futures import ThreadPoolExecutor
from urllib.parse import urlencode

import httpx
import pytest

from roslens.dashboard.journal.journal_view import PAGE, JournalView
from roslens.dashboard.journal.questions import Questions
from roslens.dashboard.journal.routes import Acting, journal_links, journal_routes
from roslens.dashboard.live.app import Facts, create_live_app
from roslens.dashboard.operator_key import OperatorKey
from roslens.model.entity import EntityId, EntityKind
from roslens.model.reaction import ActionCall, Because, Decision
from roslens.store.journal import Journal

KEY = "k" * 32
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
        self.key = OperatorKey(lambda: self.now, KEY)
        view = JournalView(self.path, lambda seconds: f"{seconds:.1f}")
        acting = Acting(self.questions, self.key)
        more = journal_routes(view, "rover", acting=acting, wall=lambda: self.now)
        app = create_live_app(lambda: b"{}", Facts(links=journal_links(acting=True)), more=more)
        self.client = Client(app)

    def write(self, *entries):
        with Journal(self.path) as journal:
            for what, fields in entries:
                journal.add(what, 100.0, **fields)

    def get(self, address):
        return self.client.get(address).text

    def answer(self, word="allow", key=KEY, headers=OWN, number=1, **more):
        told = {"decision": f"r.one/{number}.1", "answer": word, "key": key, **more}
        return self.client.post("/questions", content=urlencode(told), headers=headers)


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
    for word in ("restart node:/lidar", "the lidar is gone", "/lidar is gone", "60 s left"):
        assert word in text
    found = scene.answer(name="Ada")
    assert (found.status_code, found.headers["location"]) == (303, "questions?said=allow")
    assert scene.questions.answers() == [("r.one/1.1", True, "Ada on the page (127.0.0.1)")]
    assert scene.answer("deny").status_code == 409
    assert scene.questions.answers() == []


def test_a_denial_is_an_answer_too(scene):
    scene.questions.ask(decision(), 160.0)
    assert scene.answer("deny").status_code == 303
    assert scene.questions.answers() == [("r.one/1.1", False, "an operator on the page (127.0.0.1)")]


def test_what_is_withdrawn_or_late_is_asked_no_more(scene):
    scene.questions.ask(decision(1), 160.0)
    scene.questions.ask(decision(2), 160.0)
    scene.questions.withdraw("r.one/1.1")
    assert scene.answer(number=1).status_code == 409
    scene.now += 61.0
    assert scene.answer(number=2).status_code == 409
    assert scene.questions.answers() == []


@pytest.mark.parametrize(
    "headers",
    [
        FORM,
        {**FORM, "origin": "http://evil.example"},
        {**FORM, "origin": "null"},
        {**FORM, "origin": "null", "sec-fetch-site": "cross-site"},
        {**FORM, "origin": "https://localhost"},
        {**FORM, "origin": "http://localhost:81"},
        {**OWN, "sec-fetch-site": "cross-site"},
        {**OWN, "sec-fetch-site": "same-site"},
        {**FORM, "sec-fetch-site": "none"},
    ],
)
def test_only_a_page_of_this_server_may_answer(scene, headers):
    scene.questions.ask(decision(), 160.0)
    assert scene.answer(headers=headers).status_code == 403
    assert scene.questions.answers() == []
    assert [one.address for one in scene.questions.refusals()] == ["127.0.0.1"]


@pytest.mark.parametrize("origin", ["null", "http://localhost"])
def test_a_page_of_this_server_may_whatever_its_referrer(scene, origin):
    scene.questions.ask(decision(), 160.0)
    assert scene.answer(headers={**FORM, "origin": origin, "sec-fetch-site": "same-origin"}).status_code == 303


@pytest.mark.parametrize("key", ["", "x", KEY[:-1], KEY + "k", "ü" * 32])
def test_only_the_key_opens(scene, key):
    scene.questions.ask(decision(), 160.0)
    assert scene.answer(key=key).status_code == 403
    assert scene.questions.answers() == []
    assert len(scene.questions.refusals()) == 1


def test_many_wrong_keys_are_slowed_down_and_keep_no_operator_out(scene):
    scene.questions.ask(decision(), 160.0)
    codes = [scene.answer(key=f"guess {number}").status_code for number in range(50)]
    assert codes == [403] * 5 + [429] * 45
    assert len(scene.questions.refusals()) == 5
    assert scene.answer().status_code == 303
    scene.now += 61.0
    assert scene.answer(key="guess").status_code == 403


def test_the_key_stands_on_no_page(scene):
    scene.questions.ask(decision(), 160.0)
    for address in ("/questions", "/questions.json", "/journal", "/journal.json", "/journal/state.json"):
        assert KEY not in scene.get(address)


@pytest.mark.parametrize(
    ("method", "content", "headers", "status"),
    [
        ("GET", b"", {}, 200),
        ("PUT", b"", OWN, 405),
        ("POST", b"{}", {**OWN, "content-type": "application/json"}, 415),
        ("POST", b"a" * 20_000, OWN, 413),
        ("POST", f"key={KEY}&answer=perhaps&decision=r.one/1.1".encode(), OWN, 400),
        ("POST", b"\xff\xfe=%zz&&&=", OWN, 403),
        ("POST", f"key={KEY}&answer=allow".encode(), {**OWN, "host": "evil.example"}, 421),
    ],
)
def test_what_is_no_answer_is_none(scene, method, content, headers, status):
    scene.questions.ask(decision(), 160.0)
    assert scene.client.request(method, "/questions", content=content, headers=headers).status_code == status
    assert scene.questions.answers() == []


def test_without_questions_there_is_no_page_for_them(tmp_path):
    view = JournalView(tmp_path / "journal.jsonl", str)
    app = create_live_app(lambda: b"{}", Facts(links=journal_links(acting=False)), more=journal_routes(view, "rover"))
    client = Client(app)
    assert client.post("/questions", headers=OWN).status_code == 404
    assert 'href="questions"' not in client.get("/journal").text


def test_keys_differ_and_are_long():
    keys = {OperatorKey(time.monotonic).text for _ in range(20)}
    assert len(keys) == 20
    assert all(len(one) >= 32 for one in keys)
