"""What every answer carries, whoever made it, and who gets none."""

import asyncio
import socket
from concurrent.futures import ThreadPoolExecutor

import pytest
from dashboard.conftest import Client
from starlette.applications import Starlette
from starlette.responses import PlainTextResponse
from starlette.routing import Route

from roslens.dashboard.guard import Guard

POLICY = {
    "default-src": "'self'",
    "base-uri": "'none'",
    "form-action": "'self'",
    "frame-ancestors": "'none'",
    "object-src": "'none'",
    "img-src": "'self' data:",
}
"""Scripts, styles and connections are the server's own; nothing may be put inside, around or in the place of a page."""


def page(_request):
    return PlainTextResponse("secret", headers={"cache-control": "max-age=5"})


NAMES = ["127.0.0.1:80", "[::1]:80", "localhost", "ROBOT:8080", "robot.", socket.gethostname()]


@pytest.fixture
def client():
    return Client(Guard(Starlette(routes=[Route("/", page)]), frozenset({"robot"}), "ask somebody"))


@pytest.mark.parametrize(
    ("path", "host", "status"), [("/", "127.0.0.1", 200), ("/none", "127.0.0.1", 404), ("/", "evil.example", 421)]
)
def test_every_answer_has_the_policy_and_its_companions(client, path, host, status):
    answer = client.get(path, headers={"host": host})
    assert answer.status_code == status
    written = [part.strip() for part in answer.headers["content-security-policy"].split(";")]
    assert dict(part.split(" ", 1) for part in written) == POLICY
    assert len(written) == len(POLICY)
    assert {name: answer.headers[name] for name in answer.headers if name.startswith(("x-", "ref", "cross"))} == {
        "x-content-type-options": "nosniff",
        "referrer-policy": "no-referrer",
        "cross-origin-opener-policy": "same-origin",
        "cross-origin-resource-policy": "same-origin",
    }
    assert answer.headers["cache-control"] == ("max-age=5" if status == 200 else "no-cache")


@pytest.mark.parametrize("host", NAMES)
def test_a_name_of_this_machine_is_answered(client, host):
    assert client.get("/", headers={"host": host}).text == "secret"


@pytest.mark.parametrize("host", ["evil.example", "evil.example:80", "robot.evil.example", ""])
def test_another_name_is_told_what_to_do_and_nothing_else(client, host):
    answer = client.get("/", headers={"host": host})
    assert answer.status_code == 421
    assert answer.text == (
        f"The host name {host!r} is not one of this server. Expected localhost or an address; "
        "ask somebody to answer to another name.\n"
    )


def test_a_long_name_is_cut():
    said = Client(Guard(Starlette())).get("/", headers={"host": "a" * 500}).text
    assert "a" * 80 in said
    assert "a" * 81 not in said
    assert "start `roslens serve` with --host" in said


def test_what_is_no_request_goes_through():
    came = []

    async def app(scope, receive, send):
        came.append((scope, receive, send))

    # In a thread of its own, since tests in a browser have a loop in this one.
    with ThreadPoolExecutor(1) as thread:
        thread.submit(lambda: asyncio.run(Guard(app)({"type": "lifespan"}, "receive", "send"))).result()
    assert came == [({"type": "lifespan"}, "receive", "send")]
