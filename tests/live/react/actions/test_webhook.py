import json
import threading
from http.server import BaseHTTPRequestHandler, HTTPServer

import pytest

from roslens.live.act.actions import webhook
from roslens.live.act.ros import ActionError
from roslens.model.acting.reaction import ActionCall, Because, Decision

pytestmark = pytest.mark.timed


def decision(url, **reported):
    call = ActionCall("webhook", None, {"url": url, **reported})
    because = (Because("node:/a", "/a is gone", "gone", 1.0),)
    return Decision("r/1.0", "r", "node:/a", 0, call, 5.0, because, "node:/a", text="look at /a")


@pytest.fixture
def page():
    posted = []

    class Handler(BaseHTTPRequestHandler):
        def do_POST(self):
            posted.append(json.loads(self.rfile.read(int(self.headers["Content-Length"]))))
            code = int(self.path.strip("/"))
            self.send_response(code)
            if code == 302:
                self.send_header("Location", "/200")
            self.send_header("Content-Length", "0")
            self.end_headers()

        def log_message(self, *args):
            pass

    server = HTTPServer(("127.0.0.1", 0), Handler)
    thread = threading.Thread(target=server.serve_forever, kwargs={"poll_interval": 0.01})
    thread.start()
    server.posted = posted
    yield server
    server.shutdown()
    server.server_close()
    thread.join()


def test_what_happened_is_posted(page):
    assert "answered 204" in webhook.act(decision(f"http://127.0.0.1:{page.server_port}/204"))
    (reported,) = page.posted
    assert (reported["text"], reported["entity"], reported["because"][0]["statement"]) == (
        "look at /a",
        "node:/a",
        "/a is gone",
    )


@pytest.mark.parametrize("code", [302, 404, 500])
def test_any_other_answer_is_a_failure(page, code):
    with pytest.raises(ActionError, match=f"answered {code}"):
        webhook.act(decision(f"http://127.0.0.1:{page.server_port}/{code}", text="x"))
    assert len(page.posted) == 1, "no redirection is followed"


@pytest.mark.parametrize("url", ["file:///etc/passwd", "ftp://a/b", "http://", "nothing", "http://127.0.0.1:1/"])
def test_what_is_no_page_or_not_there_is_a_failure(url):
    with pytest.raises(ActionError):
        webhook.act(decision(url, timeout=1.0))
