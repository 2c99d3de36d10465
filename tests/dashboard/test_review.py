"""Findings accepted on the pages: what is shown, what is written, and who may."""

from __future__ import annotations

import asyncio
import re
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any
from urllib.parse import urlencode

import httpx
import pytest
from dashboard.conftest import _fake_run

from roslens.cli.served.reviewing import Reviewing
from roslens.dashboard.access.person import Person, Role
from roslens.dashboard.access.policy import Access
from roslens.dashboard.server import create_app
from roslens.model.finding import Finding

KEY, VIEW_KEY = "k" * 32, "v" * 32
NASTY = "</script><script>alert(1)</script>"


class Scene:
    """A site over a made-up run, whose accepted findings are a file."""

    def __init__(self, folder: Path) -> None:
        self.place = folder / "roslens.accepted.toml"
        site = _fake_run().FakeRun(packages=3, sources=False).site()
        site.review = Reviewing(self.place, site.view.findings)
        self.finding: Finding = next(one for one in site.view.findings() if one.fingerprint)
        holders = {KEY: Person("Ada", Role.OPERATE), VIEW_KEY: Person("Vera", Role.VIEW)}
        self.app = create_app(site, access=Access(holders))

    def ask(self, method: str, path: str, key: str = "", **given: Any) -> httpx.Response:
        headers = {"authorization": f"Bearer {key}"} if key else {}
        headers |= given.pop("headers", {})

        async def asked() -> httpx.Response:
            transport = httpx.ASGITransport(self.app)
            async with httpx.AsyncClient(transport=transport, base_url="http://localhost") as client:
                return await client.request(method, path, headers=headers, **given)

        with ThreadPoolExecutor(1) as thread:
            return thread.submit(lambda: asyncio.run(asked())).result()

    def post(self, key: str = KEY, headers: dict[str, str] | None = None, **form: str) -> httpx.Response:
        body = urlencode({"fingerprint": self.finding.fingerprint, **form})
        own = {"content-type": "application/x-www-form-urlencoded", "origin": "http://localhost"}
        return self.ask("POST", "/accept", key, content=body, headers=own | (headers or {}))


@pytest.fixture
def scene(tmp_path: Path) -> Scene:
    return Scene(tmp_path)


def test_a_finding_is_accepted_and_taken_back(scene: Scene) -> None:
    answer = scene.post(reason="the buffer is sized  by the caller", back="/findings?severity=error")
    assert (answer.status_code, answer.headers["location"]) == (303, "/findings?severity=error")
    text = scene.place.read_text()
    assert scene.finding.fingerprint in text
    assert 'reason = "the buffer is sized by the caller"' in text
    page = scene.ask("GET", "/findings", KEY).text
    assert "the buffer is sized by the caller" in page
    assert "Take it back" in page
    assert scene.post(undo="1").status_code == 303
    assert not scene.place.exists()
    assert "Take it back" not in scene.ask("GET", "/findings", KEY).text


def test_it_can_be_called_false(scene: Scene) -> None:
    scene.post(reason="never null", **{"false-positive": "1"})
    assert 'state = "false_positive"' in scene.place.read_text()
    assert "called false" in scene.ask("GET", "/findings").text


def test_other_entries_stay(scene: Scene) -> None:
    scene.place.write_text('[[accepted]]\nfingerprint = "abcdef0123456789"\nreason = "legacy"\n')
    scene.post(reason="stays")
    scene.post(undo="1")
    assert 'reason = "legacy"' in scene.place.read_text()


@pytest.mark.parametrize(
    ("form", "said"),
    [
        ({}, "no reason is given"),
        ({"reason": " \n "}, "no reason is given"),
        ({"reason": "x" * 501}, "the reason has 501 characters; expected 500 or fewer"),
        ({"reason": "why", "fingerprint": "feed"}, "'feed' is the fingerprint of no finding of this run"),
        ({"undo": "1", "fingerprint": "feed"}, "'feed' is the fingerprint of nothing that is accepted"),
    ],
)
def test_what_cannot_be_done_is_said_and_nothing_is_written(scene: Scene, form: dict[str, str], said: str) -> None:
    answer = scene.post(**form)
    assert answer.status_code == 400
    assert said in answer.text
    assert not scene.place.exists()


def test_a_file_that_cannot_be_read_is_not_written_over(scene: Scene) -> None:
    scene.place.write_text("[[accepted\n")
    answer = scene.post(reason="why")
    assert answer.status_code == 400
    assert "Fix the file first" in answer.text
    assert scene.place.read_text() == "[[accepted\n"
    assert scene.ask("GET", "/findings").status_code == 200


def test_only_who_may_operate_from_a_page_of_this_server_may(scene: Scene) -> None:
    assert scene.post(key="", reason="why").status_code in (401, 403)
    assert scene.post(key=VIEW_KEY, reason="why").status_code == 403
    assert scene.post(headers={"origin": "http://evil.example"}, reason="why").status_code == 403
    assert scene.ask("GET", "/accept", KEY).status_code in (404, 405)
    assert not scene.place.exists()


def test_who_may_only_look_has_no_form(scene: Scene) -> None:
    assert 'action="/accept"' not in scene.ask("GET", "/findings").text
    assert 'action="/accept"' not in scene.ask("GET", "/findings", VIEW_KEY).text
    assert 'action="/accept"' in scene.ask("GET", "/findings", KEY).text


@pytest.mark.parametrize(
    "back", ["//evil.example/", "/\\evil.example", "https://evil.example/", "/a\r\nset-cookie: x=1"]
)
def test_it_leads_back_to_this_server_alone(scene: Scene, back: str) -> None:
    answer = scene.post(reason="why", back=back)
    assert re.match(r"/(?![/\\])", answer.headers["location"])
    assert "set-cookie" not in answer.headers


def test_a_reason_is_text(scene: Scene) -> None:
    scene.post(reason=NASTY)
    page = scene.ask("GET", "/findings", KEY).text
    assert NASTY not in page
    assert "&lt;/script&gt;" in page
