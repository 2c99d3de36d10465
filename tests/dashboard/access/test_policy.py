"""Who is let in by a server, asked through HTTP: views, sessions, acts, origins, rates and what is written down."""

from __future__ import annotations

import asyncio
import json
from concurrent.futures import ThreadPoolExecutor
from typing import Any

import httpx
import pytest
from starlette.applications import Starlette
from starlette.requests import Request
from starlette.responses import PlainTextResponse
from starlette.routing import Mount, Route

from roslens.dashboard.access.audit import AuditFile, Entry
from roslens.dashboard.access.person import Person, Role, person_of
from roslens.dashboard.access.policy import MOST_ACTS, MOST_REFUSED, Access
from roslens.dashboard.guard import LARGEST_BODY, Guard

VIEW, OPERATE = "v" * 32, "o" * 32
HERE = "http://robot:8080"


class Server:
    """A server that acts, with a reader's browser or script in front of it."""

    def __init__(self, **rules: Any) -> None:
        self.now = 1000.0
        self.done: list[str] = []
        self.entries: list[Entry] = []
        holders = {VIEW: Person("vera", Role.VIEW), OPERATE: Person("otto", Role.OPERATE)}
        given: dict[str, Any] = {"view_needs_token": True, "audit": self.entries.append}
        access = Access(holders, wall=lambda: 5.0, steady=lambda: self.now, **{**given, **rules})
        inner = Guard(Starlette(routes=[Route("/", self.page), Route("/act", self.act, methods=["POST"])]))
        app = Starlette(routes=[Route("/act", self.act, methods=["POST"]), Mount("/in", inner), Route("/", self.page)])
        self.app = Guard(app, frozenset({"robot"}), access=access)

    def page(self, request: Request) -> PlainTextResponse:
        return PlainTextResponse(f"secret for {person_of(request).name}, {request.url.query}")

    async def act(self, request: Request) -> PlainTextResponse:
        self.done.append(f"{person_of(request).name}: {(await request.body()).decode()}")
        return PlainTextResponse("done")

    def ask(self, method: str, path: str, **given: Any) -> httpx.Response:
        async def asked() -> httpx.Response:
            async with httpx.AsyncClient(transport=httpx.ASGITransport(self.app), base_url=HERE) as client:
                return await client.request(method, path, **given)

        # In a thread of its own, since tests in a browser have a loop in this one.
        with ThreadPoolExecutor(1) as thread:
            return thread.submit(lambda: asyncio.run(asked())).result()

    def session(self, token: str) -> str:
        cookie = self.ask("GET", f"/?token={token}").headers["set-cookie"]
        return cookie.partition(";")[0]

    def act_with(self, session: str, **headers: str) -> httpx.Response:
        return self.ask("POST", "/act", content="go", headers={"cookie": session, **headers})


@pytest.fixture
def server() -> Server:
    return Server()


def bearer(token: str) -> dict[str, str]:
    return {"authorization": f"Bearer {token}"}


def test_without_a_token_nothing_is_shown_and_a_browser_gets_a_form(server: Server) -> None:
    answer = server.ask("GET", "/", headers={"accept": "text/html"})
    assert answer.status_code == 401
    assert "secret" not in answer.text
    assert '<form method="post" action="/-/sign-in">' in answer.text
    assert answer.headers["www-authenticate"] == "Bearer"
    assert "content-security-policy" in answer.headers
    assert server.ask("GET", "/").text.startswith("Open the address that `roslens` printed")
    # Who has not tried anything is not somebody to write down.
    assert server.entries == []


def test_a_script_views_with_its_token(server: Server) -> None:
    assert server.ask("GET", "/", headers=bearer(VIEW)).text == "secret for vera, "
    assert server.ask("GET", "/in/", headers=bearer(VIEW)).text == "secret for vera, "
    assert server.ask("GET", "/", headers=bearer(VIEW[:-1])).status_code == 401
    assert server.ask("GET", "/", headers={"authorization": "Bearer ü".encode("latin-1")}).status_code == 401


def test_an_address_with_a_token_becomes_a_session_without_it(server: Server) -> None:
    answer = server.ask("GET", f"/?a=1&token={VIEW}&b=")
    assert answer.status_code == 303
    assert answer.headers["location"] == "/?a=1&b="
    cookie = answer.headers["set-cookie"]
    assert VIEW not in cookie
    assert {"HttpOnly", "SameSite=lax", "Path=/"} <= {part.strip() for part in cookie.split(";")}
    assert server.ask("GET", "/", headers={"cookie": cookie.partition(";")[0]}).text == "secret for vera, "
    assert [(one.name, one.path, one.status, one.why) for one in server.entries] == [("vera", "/", 303, "signed in")]
    assert VIEW not in str(server.entries)


def test_a_token_does_not_lead_to_another_server(server: Server) -> None:
    answer = server.ask("GET", f"http://robot:8080//evil.example/x?token={VIEW}")
    assert answer.headers["location"] == "/evil.example/x"


def test_the_form_signs_in_from_this_server_alone(server: Server) -> None:
    form = {"token": OPERATE}
    answer = server.ask("POST", "/-/sign-in", data=form, headers={"origin": HERE})
    assert (answer.status_code, answer.headers["location"]) == (303, "/")
    for origin in ("http://evil.example", "http://robot:9", "null"):
        assert server.ask("POST", "/-/sign-in", data=form, headers={"origin": origin}).status_code == 403
    assert server.ask("POST", "/-/sign-in", data=form).status_code == 403


def test_who_views_does_not_act_and_who_operates_does(server: Server) -> None:
    assert server.act_with(server.session(VIEW), origin=HERE).status_code == 403
    assert server.done == []
    assert server.act_with(server.session(OPERATE), origin=HERE).text == "done"
    assert server.ask("POST", "/in/act", content="in", headers=bearer(OPERATE)).text == "done"
    assert server.done == ["otto: go", "otto: in"]
    acts = [(one.name, one.role, one.path, one.status) for one in server.entries if one.why == ""]
    assert acts == [
        ("otto", "operate", "/act", 0),
        ("otto", "operate", "/act", 200),
        ("otto", "operate", "/in/act", 0),
        ("otto", "operate", "/in/act", 200),
    ]


@pytest.mark.parametrize(
    "headers",
    [
        {},
        {"origin": "http://evil.example"},
        {"origin": "https://robot:8080"},
        {"origin": "http://robot:8081"},
        {"origin": "null"},
        {"origin": HERE, "sec-fetch-site": "cross-site"},
        {"origin": HERE, "sec-fetch-site": "same-site"},
        {"origin": HERE, "sec-fetch-site": "none"},
    ],
)
def test_another_page_does_not_act_with_the_session_of_a_reader(server: Server, headers: dict[str, str]) -> None:
    assert server.act_with(server.session(OPERATE), **headers).status_code == 403
    assert server.done == []
    assert server.entries[-1].why.startswith("Only pages of this server")


@pytest.mark.parametrize("kind", ["Basic", "Bearer", "bearer", ""])
def test_only_a_token_in_the_header_replaces_the_origin(server: Server, kind: str) -> None:
    given = f"{kind} {VIEW if kind.lower() == 'bearer' else 'x'}"
    assert server.act_with(server.session(OPERATE), authorization=given).status_code == 403
    assert server.done == []


def test_acting_is_a_post(server: Server) -> None:
    for method in ("PUT", "DELETE", "PATCH", "OPTIONS"):
        assert server.ask(method, "/act", headers=bearer(OPERATE)).status_code == 405
    assert server.ask("GET", "/act", headers=bearer(OPERATE)).status_code == 405
    assert server.done == []


def test_where_nobody_may_operate_nothing_acts() -> None:
    server = Server(view_needs_token=False)
    assert server.ask("GET", "/").text == "secret for anybody, "
    assert server.ask("POST", "/act", headers={"origin": HERE}).status_code == 403
    assert server.ask("POST", "/act", headers={"cookie": "roslens_8080=x; a=b", "origin": HERE}).status_code == 403
    # A wrong token is an error of who sent it even where none is needed.
    assert server.ask("GET", "/", headers=bearer("wrong")).status_code == 401


def test_wrong_tokens_are_told_to_wait_and_right_ones_pass(server: Server) -> None:
    for _ in range(MOST_REFUSED):
        assert server.ask("GET", "/", headers=bearer("guess")).status_code == 401
    answer = server.ask("GET", "/", headers=bearer("guess"))
    assert answer.status_code == 429
    assert int(answer.headers["retry-after"]) >= 1
    assert server.ask("GET", "/?token=guess").status_code == 429
    assert len(server.entries) == MOST_REFUSED
    assert server.ask("GET", "/", headers=bearer(VIEW)).status_code == 200
    assert server.ask("GET", f"/?token={VIEW}").status_code == 303
    assert server.ask("POST", "/-/sign-in", data={"token": VIEW}, headers={"origin": HERE}).status_code == 303
    server.now += int(answer.headers["retry-after"])
    assert server.ask("GET", "/", headers=bearer("guess")).status_code == 401


FOREIGN = [
    {"sec-fetch-site": "cross-site"},
    {"sec-fetch-site": "same-site"},
    {"origin": "http://evil.example"},
    {"origin": "null"},
    {"referer": "http://evil.example/page"},
    {"referer": "http://robot:8081/"},
]


@pytest.mark.parametrize("headers", FOREIGN)
def test_pages_of_other_origins_are_counted_apart_from_their_address(server: Server, headers: dict[str, str]) -> None:
    for _ in range(2 * MOST_REFUSED):
        answer = server.ask("GET", "/?token=x", headers=headers)
    assert answer.status_code == 429
    assert server.ask("GET", "/?token=typo").status_code == 401
    typed = {"sec-fetch-site": "none"}
    assert server.ask("GET", "/?token=typo", headers=typed).status_code == 401
    own = {"origin": HERE, "referer": HERE + "/packages", "sec-fetch-site": "same-origin"}
    assert server.ask("POST", "/-/sign-in", data={"token": "typo"}, headers=own).status_code == 401
    assert server.ask("GET", f"/?token={VIEW}", headers=headers).status_code == 303


def test_ever_new_origins_do_not_fill_the_records(server: Server) -> None:
    for number in range(5 * MOST_REFUSED):
        server.ask("GET", "/?token=x", headers={"origin": f"http://evil{number}.example"})
    assert len(server.entries) == MOST_REFUSED


def test_a_session_goes_on_while_its_address_guesses(server: Server) -> None:
    session = server.session(VIEW)
    for _ in range(2 * MOST_REFUSED):
        server.ask("GET", "/", headers=bearer("guess"))
    assert server.ask("GET", "/", headers={"cookie": session}).status_code == 200


def test_acts_come_not_too_often(server: Server) -> None:
    session = server.session(OPERATE)
    found = [server.act_with(session, origin=HERE).status_code for _ in range(MOST_ACTS + 1)]
    assert found == [200] * MOST_ACTS + [429]
    assert len(server.done) == MOST_ACTS
    server.now += 3.0
    assert server.act_with(session, origin=HERE).status_code == 200


def test_what_is_sent_has_a_bound(server: Server) -> None:
    asked = {"headers": bearer(OPERATE)}
    assert server.ask("POST", "/act", content=b"x" * LARGEST_BODY, **asked).status_code == 200
    assert server.ask("POST", "/act", content=b"x" * (LARGEST_BODY + 1), **asked).status_code == 413
    assert len(server.done) == 1


def test_what_cannot_be_written_down_is_not_done() -> None:
    def full(_: Entry) -> None:
        raise OSError("No space left on device")

    server = Server(audit=full)
    with pytest.raises(OSError, match="No space"):
        server.ask("POST", "/act", headers=bearer(OPERATE))
    assert server.done == []


def test_records_are_lines_that_their_owner_alone_reads(tmp_path) -> None:
    file = tmp_path / "audit.jsonl"
    server = Server(audit=AuditFile(file))
    server.ask("POST", "/act", headers=bearer(OPERATE))
    server.ask("GET", "/%0a{}?token=wrong")
    assert file.stat().st_mode & 0o777 == 0o600
    lines = [json.loads(line) for line in file.read_text().splitlines()]
    assert [(line["name"], line["status"]) for line in lines] == [("otto", 0), ("otto", 200), ("", 401)]
    assert lines[0] == {
        "time": 5.0, "peer": "127.0.0.1", "name": "otto", "role": "operate", "method": "POST", "path": "/act",
        "status": 0,
    }  # fmt: skip
