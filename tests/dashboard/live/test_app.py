"""The live page over HTTP: what it answers, to whom, and how its stream goes on and ends."""

from __future__ import annotations

import asyncio
import contextlib
import http.client
import json
import re
import threading
import time
from concurrent.futures import ThreadPoolExecutor
from itertools import pairwise
from urllib.parse import urlsplit

import httpx
import msgspec
import pytest
from dashboard.live.scripted_robot import ScriptedRobot

from roslens.dashboard.access.person import Person, Role
from roslens.dashboard.access.policy import Access
from roslens.dashboard.guard import HEADERS
from roslens.dashboard.live.app import Facts, create_live_app
from roslens.dashboard.live.changes import held
from roslens.dashboard.live.serving import LivePage
from roslens.dashboard.live.snapshot import Snapshot
from roslens.model.errors import UsageError
from roslens.model.graph import Graph

pytestmark = pytest.mark.timed

HOSTILE = [
    "</script><script>alert(1)</script>",
    '"><img src=x onerror=alert(1)>',
    "x" * 10_000,
    "дрон/🤖\u202e/rtl",
    "a > b",
]


class Client:
    """Asks the application without a server; not for streams, which have no end."""

    def __init__(self, robot):
        self.app = create_live_app(robot.page.newest, detail=robot.page.detail, graph=robot.page.graph)

    def get(self, path, **given):
        async def ask():
            transport = httpx.ASGITransport(self.app)
            async with httpx.AsyncClient(transport=transport, base_url="http://127.0.0.1") as client:
                return await client.get(path, **given)

        # In a thread of its own, since tests in a browser have a loop in this one.
        with ThreadPoolExecutor(1) as thread:
            return thread.submit(lambda: asyncio.run(ask())).result()


client = Client


def hostile_robot():
    nodes = {f"/{name}": name for name in HOSTILE}
    wires = [(f"/{one}", f"/t{one}", (f"/{other}",), 10, 10) for one, other in pairwise(HOSTILE)]
    reference = (
        'kind: reference\nname: hostile\ntitle: "<script>"\ndefaults: {grace: 0 s, group: "<b>"}\n'
        'constraints:\n  - {topic: "/**", rate: ">= 50 Hz", text: "</script><script>alert(2)</script>"}\n'
    )
    return ScriptedRobot(nodes, wires, reference)


def test_the_page_says_everything_without_scripts():
    robot = ScriptedRobot()
    robot.rates["/scan"] = 4
    robot.run(5)
    page = client(robot).get("/")
    assert page.status_code == 200
    table = page.text[page.text.index("<tbody") : page.text.index("</tbody>")]
    for text in ("/lidar", "/scan", "4 Hz", "58 kB/s", "rover", "12.5 %", "low"):
        assert text in table
    assert "rate is low: 4 Hz, expected 8..12 Hz; Look at the cable of the lidar" in page.text
    assert "style=" not in page.text
    embedded = re.search(
        r'<script type="application/json" id="first" data-mark="[0-9a-f]{8}\.1">(.*)</script>', page.text
    )
    assert embedded
    assert msgspec.json.decode(embedded[1], type=Snapshot) == held(
        msgspec.json.decode(robot.page.newest(), type=Snapshot)
    )


def test_the_snapshot_is_a_versioned_document():
    answer = client(ScriptedRobot()).get("/snapshot.json")
    assert answer.headers["content-type"] == "application/json"
    document = answer.json()
    assert document["version"] == 2
    assert {"time", "title", "cost", "counts", "rows", "alerts", "picture", "happened", "failures"} <= document.keys()


def test_a_detail_has_every_signal_and_what_each_constraint_says():
    robot = ScriptedRobot()
    robot.rates["/scan"] = 4
    robot.run(5)
    page = client(robot)
    found = page.get("/detail.json", params={"select": "topic:/scan"}).json()
    (judged,) = found["judgements"]
    assert (judged["state"], judged["severity"], judged["value"]) == ("low", "error", "4 Hz")
    assert (judged["expected"], judged["text"]) == ("8..12 Hz", "Look at the cable of the lidar")
    assert judged["where"].startswith("rover.yaml:")
    assert {"rate", "bandwidth", "largest_gap", "publishers", "subscribers"} <= {one["key"] for one in found["values"]}
    assert found["observed"] == "scripted"
    host = page.get("/detail.json", params={"select": "host:rover"}).json()
    assert (host["below"], [one["state"] for one in host["judgements"]]) == ("1 low below", ["ok"])


def test_the_graph_is_served_for_who_compares_it():
    robot = ScriptedRobot()
    robot.run(2)
    found = msgspec.json.decode(client(robot).get("/graph.json").content, type=Graph)
    assert "/lidar" in {one.name for one in found.nodes}


def test_what_is_not_there_has_no_detail():
    page = client(ScriptedRobot())
    for entity in ("topic:/nothing", "", "x" * 10_000, "</script>"):
        answer = page.get("/detail.json", params={"select": entity})
        assert (answer.status_code, answer.content) == (204, b"")


def test_every_file_that_the_page_names_is_there():
    page = client(ScriptedRobot())
    found, waiting = set(), {f"/{name}" for name in re.findall(r'(?:href|src)="(web/[^"]+)"', page.get("/").text)}
    assert "/web/live/main.js" in waiting
    while waiting:
        path = waiting.pop()
        found.add(path)
        answer = page.get(path)
        assert answer.status_code == 200, path
        for name in re.findall(r'^import .* from "([^"]+)";$', answer.text, re.MULTILINE):
            waiting |= {str(answer.url.join(name).path)} - found
    assert "/web/graph/camera.js" in found


@pytest.mark.parametrize("path", ["/", "/snapshot.json", "/web/live/main.js", "/nothing"])
def test_every_answer_carries_the_policy(path):
    answer = client(ScriptedRobot()).get(path)
    for name, value in HEADERS.items():
        assert answer.headers[name] == value


@pytest.mark.parametrize("path", ["/", "/snapshot.json", "/events", "/web/live/main.js"])
def test_a_foreign_host_name_is_refused(path):
    answer = client(ScriptedRobot()).get(path, headers={"host": "evil.example"})
    assert answer.status_code == 421
    assert "--serve HOST:PORT" in answer.text


@pytest.mark.parametrize("path", ["/snapshot.json", "/events"])
@pytest.mark.parametrize("site", ["cross-site", "same-site"])
def test_another_origin_may_not_read(path, site):
    answer = client(ScriptedRobot()).get(path, headers={"sec-fetch-site": site})
    assert answer.status_code == 403


def test_hostile_names_stay_text():
    robot = hostile_robot()
    robot.run(5)
    page = client(robot).get("/").text
    assert "<script>alert" not in page
    assert "<img src=x" not in page
    assert page.count("<script") == 3
    document = client(robot).get("/snapshot.json").json()
    assert any("</script>" in row["entity"] for row in document["rows"])
    assert max(len(row["name"]) for row in document["rows"]) <= 210
    assert document["alerts"]
    assert all(len(alert["message"]) < 700 for alert in document["alerts"])


class Reader:
    """Reads a stream event by event."""

    def __init__(self, url, headers):
        parts = urlsplit(url)
        self.marks, self.last = [], None
        self.connection = http.client.HTTPConnection(parts.hostname, parts.port, timeout=20)
        self.connection.request("GET", "/events", headers=headers)
        self.answer = self.connection.getresponse()

    def close(self):
        self.answer.close()
        self.connection.close()

    def event(self):
        lines = {}
        while True:
            line = self.answer.readline()
            if not line:
                return None
            text = line.decode().rstrip("\n")
            if text:
                name, _, value = text.partition(":")
                lines[name] = value.strip()
            elif "event" in lines:
                return lines
            else:
                lines = {}

    def piece(self):
        """Return the next piece that is no beat; None at the end."""
        while (event := self.event()) is not None:
            if event["event"] != "beat":
                self.marks.append(event["id"])
                self.last = json.loads(event["data"])
                return event["event"], self.last
        return None

    def snapshot(self):
        found = self.piece()
        return found and found[1]


@pytest.fixture
def read():
    """Open streams that are closed at the end."""
    with contextlib.ExitStack() as stack:

        def open_(url, headers=None):
            reader = Reader(url, headers or {})
            stack.callback(reader.close)
            return reader

        yield open_


@pytest.fixture
def served():
    robot = ScriptedRobot()
    with LivePage(robot.page.newest) as page:
        yield robot, page


def test_the_stream_tells_all_once_and_then_what_changed(served, read):
    robot, page = served
    reader = read(page.url)
    assert reader.answer.headers["content-type"].startswith("text/event-stream")
    name, first = reader.piece()
    assert name == "state"
    assert first["time"] == robot.now
    robot.rates["/scan"] = 9
    robot.run()
    name, change = reader.piece()
    assert name == "change"
    assert change["parts"]["time"] == first["time"] + 1
    assert "rows" not in change
    assert 0 < len(change["cells"]) < len(first["rows"])


def test_who_comes_back_is_told_what_it_missed(served, read):
    robot, page = served
    reader = read(page.url)
    reader.piece()
    (mark,) = reader.marks
    reader.close()
    # Somebody else keeps the stream going meanwhile.
    other = read(page.url)
    other.piece()
    robot.run()
    other.piece()
    again = read(page.url, {"last-event-id": mark})
    assert again.piece() == ("change", other.last)


@pytest.mark.parametrize("mark", ["", "x", "00000000.1", "deadbeef.", ".5", "9" * 400])
def test_who_comes_back_with_what_is_not_known_is_told_all(served, read, mark):
    assert read(served[1].url, {"last-event-id": mark}).piece()[0] == "state"


def test_nothing_new_is_told_by_a_beat(served, read):
    reader = read(served[1].url)
    assert reader.snapshot() is not None
    assert reader.event() == {"event": "beat", "data": ""}


def test_who_comes_late_gets_the_newest_alone(read):
    first = msgspec.json.decode(ScriptedRobot().page.newest(), type=Snapshot)
    newest = [msgspec.json.encode(first)]
    with LivePage(lambda: newest[0]) as page:
        reader = read(page.url)
        assert reader.snapshot() is not None
        for time_ in range(500):
            newest[0] = msgspec.json.encode(msgspec.structs.replace(first, time=1000.0 + time_))
        told = [reader.piece()[1]["parts"]["time"]]
        while told[-1] != 1499.0:
            told.append(reader.piece()[1]["parts"]["time"])
        assert len(told) < 10
        assert reader.event()["event"] == "beat"


def test_the_stream_ends_when_the_watch_does(read):
    robot = ScriptedRobot()
    with LivePage(robot.page.newest) as page:
        reader = read(page.url)
        assert reader.snapshot() is not None
        begun = time.monotonic()
    assert time.monotonic() - begun < 4
    assert reader.snapshot() is None
    assert not [one for one in threading.enumerate() if one.name == "live page"]


def test_a_reader_that_went_away_makes_room(served, read):
    _, page = served
    for _ in range(3):
        reader = read(page.url)
        assert reader.snapshot() is not None
        reader.close()
    assert read(page.url).snapshot() is not None


def test_a_port_that_is_taken_is_said(served):
    port = urlsplit(served[1].url).port
    with pytest.raises(UsageError, match=r"expected a free port\. Give --serve another port"):
        LivePage(served[0].page.newest, port=port)


def board_client(robot, person=None):
    """Return a client of an application in which a token may operate."""
    access = Access({"t" * 32: person or Person("anna", Role.OPERATE)})
    facts = Facts(access=access)
    asking = Client(robot)
    asking.app = create_live_app(robot.page.newest, facts, detail=robot.page.detail, board=robot.page.board)
    return asking


def posted(asking, headers=None, **form):
    async def ask():
        transport = httpx.ASGITransport(asking.app)
        async with httpx.AsyncClient(transport=transport, base_url="http://127.0.0.1") as client:
            return await client.post("/handle", data=form, headers=headers or {})

    with ThreadPoolExecutor(1) as thread:
        return thread.submit(lambda: asyncio.run(ask())).result()


def test_an_alert_is_acknowledged_by_who_may_operate_alone():
    robot = ScriptedRobot()
    robot.rates["/scan"] = 4
    robot.run(5)
    (alert,) = json.loads(robot.page.newest())["alerts"]
    held = {"authorization": f"Bearer {'t' * 32}"}
    asking = board_client(robot)
    assert posted(asking, key=alert["key"], how="acknowledge").status_code == 403
    viewer = board_client(robot, Person("eve", Role.VIEW))
    assert posted(viewer, held, key=alert["key"], how="acknowledge").status_code == 403
    done = posted(asking, held, key=alert["key"], how="acknowledge")
    assert (done.status_code, done.headers["location"]) == (303, "./")
    robot.run()
    (noted,) = json.loads(robot.page.newest())["alerts"]
    assert (noted["handled"], noted["by"]) == ("acknowledged", "anna")
    bad = posted(asking, held, key=alert["key"], how="mute", **{"for": "nan"})
    assert (bad.status_code, bad.text) == (400, "for='nan'; expected seconds.\n")


def test_the_page_of_references_says_what_is_about_nothing():
    robot = ScriptedRobot(wires=[("/lidar", "/scan", ("/slam",), 10, 100)])
    robot.run(40)
    asking = board_client(robot)
    page = asking.get("/references").text
    assert "matches nothing" in page
    assert "style=" not in page
    assert asking.get("/references.json").json()["constraints"][0].get("count", 0) == 0
    assert asking.get("/references", params={"accept": "topic:/nothing"}).text.count("constraints: []") == 1
    assert asking.get("/accepted.yaml").headers["content-disposition"].startswith("attachment")


def test_without_a_reference_the_page_says_so_and_counts_nothing():
    robot = ScriptedRobot()
    assert robot.page.end_at(robot.now)
    page = board_client(robot).get("/references").text
    assert "No reference was given, or this is a stored history" in page
    assert "0 constraints" not in page


def test_what_a_constraint_is_about_leads_to_what_runs():
    page = board_client(ScriptedRobot()).get("/references").text
    assert 'topic <a class="entity" href="./?select=topic%3A/scan">/scan</a>' in page
    assert "<bdi>node /*</bdi>" in page


def test_hostile_names_stay_text_on_the_page_of_references():
    robot = hostile_robot()
    robot.run(40)
    page = board_client(robot).get("/references", params={"accept": HOSTILE[0]}).text
    assert "<script>alert" not in page
    assert "<img src=x" not in page


@pytest.mark.parametrize("path", ["/snapshot.json?at=x", "/plots.json?select=a", "/compared?from=1&to=inf"])
def test_an_address_that_is_no_moment_is_refused_with_what_was_expected(path):
    robot = ScriptedRobot()
    asking = Client(robot)
    asking.app = create_live_app(robot.page.newest, detail=robot.page.detail, past=robot.page.past)
    answer = asking.get(path)
    assert answer.status_code == 400
    assert "expected seconds since the epoch" in answer.text


def test_of_very_many_rows_the_page_has_the_first_and_a_link_to_all(monkeypatch):
    monkeypatch.setattr("roslens.dashboard.live.app.MOST_PLAIN", 5)
    asking = client(ScriptedRobot())
    rows = len(asking.get("/snapshot.json").json()["rows"])
    page = asking.get("/").text
    assert page.count("<tr class=") == 5
    assert f'5 of {rows} rows; <a href="?all=1">all of them</a>' in page
    whole = asking.get("/?all=1").text
    assert whole.count("<tr class=") == rows
    assert "of them</a>" not in whole
