import contextlib
import threading
import time
import xmlrpc.client

import pytest
from hypothesis import given
from hypothesis import strategies as st

from roslens.live.adapters.ros1.resolve import Resolver
from roslens.live.adapters.ros1.wire.xml_rpc import (
    Caller,
    CallError,
    Trouble,
    read_answer,
    read_message,
    split_uri,
    unwrap,
)

pytestmark = pytest.mark.timed

ANSWER = xmlrpc.client.dumps(([1, "text", [["/a", ["/n", "ü"]], -1, True, 2.5]],), methodresponse=True).encode()


def trouble_of(caller, *call):
    with pytest.raises(CallError) as caught:
        caller.call(*(call or ("getPid", "/x")))
    return caught.value.trouble, str(caught.value)


@pytest.fixture
def caller_to():
    made = []

    def make(port, wait_s=1.0, **options):
        made.append(Caller(f"http://127.0.0.1:{port}", Resolver(), wait_s, **options))
        return made[-1]

    yield make
    for caller in made:
        caller.close()


def test_an_answer_is_returned_and_the_connection_kept(serve):
    server = serve({"echo": lambda *arguments: list(arguments)})
    caller = Caller(server.uri, Resolver())
    assert caller.call("echo", "/x", "äöü <&>", 7) == ["/x", "äöü <&>", 7]
    first = caller.descriptor
    assert caller.call("echo", "/y") == ["/y"]
    assert caller.descriptor == first >= 0
    caller.close()
    assert caller.descriptor == -1


def test_a_connection_that_was_closed_while_idle_is_opened_again(serve):
    server = serve({"getPid": [1, "", 5]})
    caller = Caller(server.uri, Resolver())
    assert caller.call("getPid") == [1, "", 5]
    server.hang_up()
    assert caller.call("getPid") == [1, "", 5]
    caller.close()


def test_a_server_that_ended_refuses(serve):
    server = serve({"getPid": [1, "", 5]})
    caller = Caller(server.uri, Resolver())
    caller.call("getPid")
    server.close()
    trouble, text = trouble_of(caller)
    assert trouble is Trouble.REFUSED
    assert "refuses connections" in text


def test_silence_ends_in_time(script, caller_to):
    caller = caller_to(script(lambda line, done: done.wait()), wait_s=0.1)
    begun = time.monotonic()
    trouble, text = trouble_of(caller)
    assert trouble is Trouble.SILENT
    assert "does not answer within 0.1 s" in text
    assert time.monotonic() - begun < 30, "the other side stays silent for ever"


def test_an_answer_that_drips_ends_in_time(script, caller_to):
    def drip(line, done):
        line.recv(65536)
        line.sendall(b"HTTP/1.1 200 OK\r\nContent-Length: 1000\r\n\r\n")
        while not done.wait(0.01):
            line.sendall(b"x")

    begun = time.monotonic()
    assert trouble_of(caller_to(script(drip), wait_s=0.2))[0] is Trouble.SILENT
    assert time.monotonic() - begun < 8, "all of it comes after ten seconds"


@pytest.mark.parametrize(
    ("sent", "found"),
    [
        (b"", "hung up"),
        (b"SSH-2.0-OpenSSH_9.2\r\n\r\n", "instead of HTTP 200"),
        (b"x" * 40_000, "does not speak HTTP"),
        (b"HTTP/1.1 404 Not Found\r\nContent-Length: 0\r\n\r\n", "404"),
        (b"HTTP/1.1 200 OK\r\nContent-Length: 900000000000\r\n\r\n", "900,000,000,000 bytes"),
        (b"HTTP/1.1 200 OK\r\nContent-Length: 10\r\n\r\nabc", "hung up"),
        (b"HTTP/1.0 200 OK\r\n\r\n" + b"<" * 5000, "at most|more than|no XML-RPC"),
        (b"HTTP/1.1 200 OK\r\nContent-Length: 9\r\n\r\nnot at al", "not XML-RPC"),
    ],
)
def test_what_is_no_answer_is_garbled(script, caller_to, sent, found):
    def play(line, done):
        line.recv(65536)
        line.sendall(sent)
        line.close()

    caller = caller_to(script(play), largest=2000)
    with pytest.raises(CallError, match=found) as caught:
        caller.call("getPid", "/x")
    assert caught.value.trouble is Trouble.GARBLED
    assert len(str(caught.value)) < 600


def test_an_answer_without_a_length_ends_with_the_connection(script, caller_to):
    def play(line, done):
        line.recv(65536)
        line.sendall(b"HTTP/1.0 200 OK\r\n\r\n" + ANSWER)
        line.close()

    caller = caller_to(script(play))
    assert caller.call("x")[1] == "text"
    assert caller.descriptor == -1


def test_a_fault_is_a_denial():
    body = xmlrpc.client.dumps(xmlrpc.client.Fault(1, "OverflowError: int exceeds XML-RPC limits"), methodresponse=True)
    with pytest.raises(CallError, match="int exceeds") as caught:
        read_answer(body.encode(), "getBusStats")
    assert caught.value.trouble is Trouble.DENIED


def test_entities_are_not_expanded():
    bomb = b'<!DOCTYPE x [<!ENTITY a "aaaa">]>' + ANSWER.replace(b"text", b"&a;")
    with pytest.raises(CallError, match="entities"):
        read_answer(bomb, "getPid")


@pytest.mark.parametrize("answer", [None, 1, "1", [], [1, ""], ["1", "", 0], [1, "", 0, 0], {}])
def test_another_form_than_code_message_value_is_garbled(answer):
    with pytest.raises(CallError) as caught:
        unwrap(answer, "getPid")
    assert caught.value.trouble is Trouble.GARBLED


def test_a_code_other_than_1_is_a_denial():
    assert unwrap([1, "", 7], "getPid") == 7
    with pytest.raises(CallError, match="unknown node") as caught:
        unwrap([-1, "unknown node [/a]", ""], "lookupNode")
    assert caught.value.trouble is Trouble.DENIED


@pytest.mark.parametrize(
    "uri",
    [
        "",
        "localhost:11311",
        "https://a:1/",
        "http://",
        "http://a",
        "http://a:0",
        "http://a:99999/",
        "http://a:b/",
        "http://[::1",
        "rosrpc://a:3",
    ],
)
def test_what_is_no_uri_is_told(uri):
    with pytest.raises(CallError, match="not a URI"):
        split_uri(uri)


def test_addresses_of_both_families_are_read():
    assert split_uri("http://robot-1.local:11311/") == ("robot-1.local", 11311)
    assert split_uri("http://[::1]:80") == ("::1", 80)


def test_a_host_without_address_is_unreachable():
    def ask(host):
        raise OSError("Name or service not known")

    caller = Caller("http://ro\u0308bot:1234/", Resolver(ask))
    trouble, text = trouble_of(caller)
    assert trouble is Trouble.UNREACHABLE
    assert "not known here" in text


@given(st.binary(max_size=300))
def test_no_bytes_make_it_fall_over(body):
    with contextlib.suppress(CallError):
        read_message(body, "this")


@given(st.integers(0, len(ANSWER) - 1), st.binary(max_size=4), st.integers(0, 40))
def test_no_damaged_answer_makes_it_fall_over(place, put, gone):
    with contextlib.suppress(CallError):
        unwrap(read_answer(ANSWER[:place] + put + ANSWER[place + gone :], "x"), "x")


@given(st.binary(max_size=200))
def test_no_stream_makes_a_call_fall_over_or_last(stream):
    import socket as sockets

    here, there = sockets.socketpair()
    with here, there:
        there.sendall(stream)
        there.shutdown(sockets.SHUT_WR)
        caller = Caller("http://127.0.0.1:9", Resolver())
        with contextlib.suppress(CallError, EOFError):
            caller._exchange(here, b"", time.monotonic() + 1)


def test_threads_can_use_a_resolver_together():
    asked = []
    gate = threading.Event()

    def ask(host):
        asked.append(host)
        gate.wait(5)
        return "10.0.0.1"

    resolver = Resolver(ask, wait_s=5)
    found = []
    threads = [threading.Thread(target=lambda: found.append(resolver.address("robot"))) for _ in range(8)]
    for thread in threads:
        thread.start()
    gate.set()
    for thread in threads:
        thread.join()
    assert found == ["10.0.0.1"] * 8
    assert len(asked) == 1


TEXT = st.text(st.characters(codec="utf-8", exclude_categories=["Cc", "Cs"]), max_size=6)
VALUES = st.recursive(
    st.booleans() | st.integers(-(2**31), 2**31 - 1) | st.floats(allow_nan=False, allow_infinity=False) | TEXT,
    lambda inner: st.lists(inner, max_size=4) | st.dictionaries(TEXT, inner, max_size=3),
    max_leaves=20,
)


@given(VALUES)
def test_every_value_is_read_as_the_standard_library_reads_it(value):
    body = xmlrpc.client.dumps((value,), methodresponse=True).encode()
    try:
        expected = read_message(body, "this")[0][0]
    except CallError:  # characters that XML cannot carry
        return
    assert read_answer(body, "x") == expected


def test_depth_has_an_end():
    deep = b"<value>" + b"<array><data><value>" * 50_000 + b"</value></data></array>" * 50_000 + b"</value>"
    with pytest.raises(CallError, match="nested more than 32"):
        read_answer(b"<methodResponse><params><param>" + deep + b"</param></params></methodResponse>", "x")
    with pytest.raises(CallError, match="type 'matrix'"):
        read_answer(ANSWER.replace(b"<string>text</string>", b"<matrix/>"), "x")
