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
                assert answer.read().decode() == expected
        with pytest.raises(urllib.error.HTTPError, match="only /metrics"):
            urllib.request.urlopen(endpoint.url + "x")
    finally:
        endpoint.close()
    with pytest.raises(urllib.error.URLError):
        urllib.request.urlopen(endpoint.url)


def test_who_makes_no_page_in_time_is_named():
    def page():
        raise TimeoutError("no answer for 5 s")

    endpoint = Endpoint(("127.0.0.1", 0), page)
    try:
        with pytest.raises(urllib.error.HTTPError, match="503: no answer for 5 s"):
            urllib.request.urlopen(endpoint.url)
    finally:
        endpoint.close()
