import socket
import urllib.error
import urllib.request

import pytest

from roslens.live.publish.endpoint import Endpoint


def test_the_page_is_made_anew_for_each_request():
    pages = iter(["one\n", "two é\n"])
    endpoint = Endpoint(("127.0.0.1", 0), lambda: next(pages))
    try:
        for expected in ("one\n", "two é\n"):
            with urllib.request.urlopen(endpoint.url) as answer:
                assert answer.headers["Content-Type"].startswith("text/plain; version=0.0.4")
                assert answer.headers["Content-Length"] == str(len(expected.encode()))
                assert answer.read().decode() == expected
        with pytest.raises(urllib.error.HTTPError, match="only /metrics") as refused:
            urllib.request.urlopen(endpoint.url + "x")
        refused.value.close()
    finally:
        endpoint.close()
    with pytest.raises(urllib.error.URLError):
        urllib.request.urlopen(endpoint.url)


@pytest.mark.parametrize(
    ("hosts", "status"),
    [
        (["127.0.0.1"], 200),
        (["127.0.0.1:9411"], 200),
        (["[::1]:9411"], 200),
        (["LocalHost:9411"], 200),
        ([socket.gethostname()], 200),
        (["evil.example"], 421),
        (["127.0.0.1.evil.example"], 421),
        (["localhost.evil.example:9411"], 421),
        ([""], 421),
        ([], 421),
        (["localhost", "evil.example"], 421),
    ],
)
def test_a_page_that_reaches_it_through_a_name_of_its_own_reads_nothing(hosts, status):
    endpoint = Endpoint(("127.0.0.1", 0), lambda: "secret 1\n")
    try:
        with socket.create_connection(endpoint._server.server_address) as line:
            line.sendall(
                b"GET /metrics HTTP/1.0\r\n" + b"".join(b"Host: %s\r\n" % one.encode() for one in hosts) + b"\r\n"
            )
            answer = b"".join(iter(lambda: line.recv(65_536), b""))
    finally:
        endpoint.close()
    assert int(answer.split()[1]) == status
    assert (b"secret" in answer) is (status == 200)


def test_who_makes_no_page_in_time_is_named():
    def page():
        raise TimeoutError("no answer for 5 s")

    endpoint = Endpoint(("127.0.0.1", 0), page)
    try:
        with pytest.raises(urllib.error.HTTPError, match="503: no answer for 5 s") as refused:
            urllib.request.urlopen(endpoint.url)
        refused.value.close()
    finally:
        endpoint.close()
