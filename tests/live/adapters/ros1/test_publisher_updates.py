import http.client
import queue
import xmlrpc.client

import pytest
from hypothesis import given
from hypothesis import strategies as st

from roslens.live.adapters.ros1.place import is_local
from roslens.live.adapters.ros1.publisher_updates import UpdateServer, answer_to
from roslens.live.adapters.ros1.resolve import Resolver
from roslens.live.adapters.ros1.wire.xml_rpc import Caller

pytestmark = pytest.mark.timed


@pytest.fixture
def reported():
    heard = queue.SimpleQueue()
    server = UpdateServer("127.0.0.1", "127.0.0.1", "http://m:1", lambda *update: heard.put(update))
    server.heard = heard
    yield server
    server.close()


def test_updates_are_passed_on(reported):
    caller = Caller(reported.uri, Resolver())
    assert caller.call("publisherUpdate", "/master", "/rosout", ["http://a:1/", 7]) == [1, "", 0]
    assert reported.heard.get(timeout=30) == ("/rosout", ("http://a:1/",))
    assert caller.call("publisherUpdate", "/master", "/rosout")[0] == -1
    caller.close()


def test_parameters_are_passed_on(reported):
    reported.parameter_reported = lambda *update: reported.heard.put(update)
    caller = Caller(reported.uri, Resolver())
    assert caller.call("paramUpdate", "/master", "/a/b/", {"c": [1, 2.5]}) == [1, "", 0]
    assert reported.heard.get(timeout=30) == ("/a/b/", {"c": [1, 2.5]})
    assert caller.call("paramUpdate", "/master", 7, {})[0] == -1
    caller.close()


def test_who_asks_is_answered_as_by_a_node(reported):
    caller = Caller(reported.uri, Resolver())
    assert caller.call("getPid", "/x")[0] == 1
    assert caller.call("getMasterUri", "/x") == [1, "", "http://m:1"]
    assert caller.call("getBusStats", "/x") == [1, "", [[], [], []]]
    assert caller.call("shutdown", "/x", "bye")[0] == 0
    assert caller.call("requestTopic", "/x", "/t", [["TCPROS"]])[0] == 0
    assert caller.call("system.listMethods")[0] == -1
    caller.close()


def test_more_can_be_answered():
    more = {"requestTopic": lambda arguments: [1, "", [arguments[1]]]}
    server = UpdateServer("127.0.0.1", "127.0.0.1", "http://m:1", lambda *_: None, more)
    caller = Caller(server.uri, Resolver())
    assert caller.call("requestTopic", "/x", "/t", [["TCPROS"]]) == [1, "", ["/t"]]
    caller.close()
    server.close()


@pytest.mark.parametrize("length", ["900000000000", "-1", "x", ""])
def test_a_length_that_is_none_is_refused(reported, length):
    line = http.client.HTTPConnection(reported.uri[7:-1], timeout=5)
    line.putrequest("POST", "/RPC2")
    line.putheader("Content-Length", length)
    line.endheaders()
    answer = line.getresponse()
    assert answer.status == 400
    answer.read()
    line.close()


@given(st.binary(max_size=200))
def test_no_bytes_make_it_fall_over(body):
    values, _ = xmlrpc.client.loads(answer_to(body, {}))
    assert values[0][0] == -1


@pytest.mark.skipif(not is_local("::1"), reason="no IPv6 on this host")
def test_it_listens_on_ipv6():
    server = UpdateServer("::1", "::1", "http://m:1", lambda *update: None)
    assert server.uri.startswith("http://[::1]:")
    caller = Caller(server.uri, Resolver())
    assert caller.call("getPid", "/x")[0] == 1
    caller.close()
    server.close()
