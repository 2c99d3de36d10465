"""Documents from a server that breaks, limits, redirects and floods."""

import threading
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer

import pytest

from roslens.model.errors import UsageError
from roslens.source.fetch import document
from roslens.source.fetch.retry import Retry, may_pass


class Answers(BaseHTTPRequestHandler):
    """Answers with what the test put there: status, headers and body, one after the other."""

    def do_GET(self):
        status, headers, body = self.server.answers.pop(0)
        self.send_response(status)
        for name, value in headers.items():
            self.send_header(name, value)
        self.send_header("Content-Length", str(len(body)))
        self.end_headers()
        self.wfile.write(body)

    def log_message(self, *_):
        pass


@pytest.fixture
def site(monkeypatch):
    monkeypatch.setenv("no_proxy", "*")
    with ThreadingHTTPServer(("127.0.0.1", 0), Answers) as server:
        server.answers = []
        server.url = f"http://127.0.0.1:{server.server_address[1]}/d.yaml"
        thread = threading.Thread(target=server.serve_forever, args=(0.01,))
        thread.start()
        try:
            yield server
        finally:
            server.shutdown()
            thread.join()


def read(url, pauses=None):
    return document.reader(Retry((pauses if pauses is not None else []).append), offline=False)(url)


@pytest.mark.parametrize("status", [429, 500, 502, 503, 504])
def test_what_may_pass_is_asked_again(site, status):
    site.answers = [(status, {}, b""), (status, {}, b""), (200, {}, b"a: 1")]
    pauses = []
    assert read(site.url, pauses) == b"a: 1"
    assert pauses == [2.0, 8.0]


@pytest.mark.parametrize("status", [401, 403, 404])
def test_what_stays_is_not(site, status):
    site.answers = [(status, {}, b"")]
    with pytest.raises(UsageError, match=f"the server answers {status}"):
        read(site.url)


def test_it_gives_up_at_last(site):
    site.answers = [(503, {}, b"")] * 4
    pauses = []
    with pytest.raises(UsageError, match="503"):
        read(site.url, pauses)
    assert pauses == [2.0, 8.0, 30.0]


def test_it_follows_to_the_web_and_to_nothing_else(site):
    site.answers = [(302, {"Location": site.url}, b""), (200, {}, b"b: 2")]
    assert read(site.url) == b"b: 2"
    for place in ("file:///etc/passwd", "ftp://127.0.0.1/x"):
        site.answers = [(302, {"Location": place}, b"")] * 4
        with pytest.raises(UsageError, match=place):
            read(site.url)


def test_more_than_a_document_has_is_not_read(site, monkeypatch):
    monkeypatch.setattr(document, "MOST_BYTES", 10)
    site.answers = [(200, {}, b"x" * 11)]
    with pytest.raises(UsageError, match="more than 10 bytes"):
        read(site.url)


@pytest.mark.parametrize(
    ("complaint", "again"),
    [
        ("fatal: unable to access 'https://h/': Could not resolve host: h", True),
        ("fatal: early EOF", True),
        ("error: RPC failed; HTTP 503", True),
        ("The requested URL returned error: 429", True),
        ("fatal: repository 'https://h/x/' not found", False),
        ("The requested URL returned error: 403", False),
        ("fatal: could not read Username for 'https://h': terminal prompts disabled", False),
        ("git@h: Permission denied (publickey).", False),
    ],
)
def test_which_complaints_of_git_may_pass(complaint, again):
    assert may_pass(complaint) is again
