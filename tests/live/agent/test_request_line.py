"""Agent and monitor over a real encrypted line on this machine."""

import contextlib
import queue
import shutil
import socket
import ssl
import time

import pytest

from roslens.live.agent.enrol import enrol, read_agent, read_monitor
from roslens.live.agent.host_hand import Done
from roslens.live.agent.request_gate import RequestGate
from roslens.live.agent.request_line import RequestLine
from roslens.live.react.far_agents import FarAgents
from roslens.model.acting.host_request import HostRequest
from roslens.model.errors import UsageError

pytestmark = [
    pytest.mark.timed,
    pytest.mark.skipif(not shutil.which("openssl"), reason="openssl is not installed"),
]

WAIT_S = 20.0
REQUEST = HostRequest("r/1.0", "restart", "/driver", 77)


@pytest.fixture(scope="module")
def keys(tmp_path_factory):
    folder = tmp_path_factory.mktemp("keys")
    enrol(folder, "arm")
    enrol(folder, "leg")
    return folder


class Hand:
    """Does at once what it is asked."""

    def __init__(self):
        self.begun = queue.SimpleQueue()
        self.line = None

    def refusal(self, request):
        return "not on the allow-list" if request.kind == "kill" else ""

    def begin(self, request):
        self.begun.put(request)
        self.line.tell(Done(request.id, True, False, "started", 0.5))


class Scene:
    def __init__(self, keys):
        self.keys = keys
        self.said, self.reported, self.written = [], [], []
        self.monitor = FarAgents(("127.0.0.1", 0), read_monitor(keys / "monitor"), self.said.append)
        self.agents = []

    def agent(self, host="arm", keys=None, name=None):
        hand = Hand()
        address = ("127.0.0.1", self.monitor.port)
        line = RequestLine(name or host, address, read_agent((keys or self.keys) / host), self.reported.append)
        hand.line = line
        refused = lambda request, why: line.tell(Done(request.id, False, True, why))  # noqa: E731
        line.start(RequestGate(hand, self.written.append, refused))
        self.agents.append(line)
        return hand

    def asked(self, host="arm", request=REQUEST):
        wait_until(lambda: host in self.monitor.hosts() and self.monitor.ask(host, request) == "")
        found = []
        wait_until(lambda: found.extend(self.monitor.poll()) or found)
        return found[0]

    def close(self):
        for one in self.agents:
            one.close()
        self.monitor.close()


def wait_until(true):
    end = time.monotonic() + WAIT_S
    while not true():
        assert time.monotonic() < end
        time.sleep(0.01)


@pytest.fixture
def scene(keys):
    found = Scene(keys)
    yield found
    found.close()


def test_an_enrolled_monitor_asks_an_enrolled_agent(scene):
    hand = scene.agent()
    found = scene.asked()
    assert (found.decision, found.done, found.text, found.duration_s) == ("r/1.0", True, "arm: started", 0.5)
    assert hand.begun.get(timeout=WAIT_S) == REQUEST
    found = scene.asked(request=HostRequest("r/2.0", "kill", "/driver", 77))
    assert (found.done, found.refused, found.text) == (False, True, "arm: not on the allow-list")
    assert hand.begun.empty()


def test_each_host_is_asked_on_its_own_line(scene):
    arm, leg = scene.agent("arm"), scene.agent("leg")
    assert scene.asked("leg").text == "leg: started"
    assert leg.begun.get(timeout=WAIT_S) == REQUEST
    assert arm.begun.empty()
    assert "never enrolled" in scene.monitor.ask("tail", REQUEST)


def test_an_agent_that_calls_itself_otherwise_believes_nothing(scene):
    hand = scene.agent("arm", name="other")
    wait_until(lambda: scene.monitor.ask("arm", REQUEST) == "")
    wait_until(lambda: scene.written)
    assert "meant for 'arm'" in scene.written[0]
    assert hand.begun.empty()


def test_an_agent_of_another_enrolment_is_not_let_in(scene, tmp_path):
    enrol(tmp_path, "arm")
    scene.agent("arm", tmp_path)
    wait_until(lambda: scene.said and scene.reported)
    assert scene.monitor.hosts() == ()
    assert "certificate verify failed" in scene.reported[0].lower() or "CERTIFICATE_VERIFY_FAILED" in scene.reported[0]
    assert "is not connected" in scene.monitor.ask("arm", REQUEST)


def test_who_shows_no_certificate_or_speaks_no_tls_is_hung_up_on(scene):
    with socket.create_connection(("127.0.0.1", scene.monitor.port)) as plain:
        plain.sendall(b"GET / HTTP/1.1\r\n\r\n")
        plain.settimeout(WAIT_S)
        with contextlib.suppress(ConnectionResetError):
            while plain.recv(100):
                pass
    context = ssl.SSLContext(ssl.PROTOCOL_TLS_CLIENT)
    context.check_hostname, context.verify_mode = False, ssl.CERT_NONE
    with (
        contextlib.suppress(OSError),
        socket.create_connection(("127.0.0.1", scene.monitor.port)) as plain,
        context.wrap_socket(plain) as line,
    ):
        line.settimeout(WAIT_S)
        assert not line.recv(100)
    assert scene.monitor.hosts() == ()
    scene.agent()
    assert scene.asked().done, "others are served all the same"


def test_what_was_asked_when_the_line_broke_has_failed(scene):
    hand = scene.agent()
    hand.line = type("Silent", (), {"tell": lambda *_: None})()
    wait_until(lambda: "arm" in scene.monitor.hosts() and scene.monitor.ask("arm", REQUEST) == "")
    hand.begun.get(timeout=WAIT_S)
    scene.agents.pop().close()
    found = []
    wait_until(lambda: found.extend(scene.monitor.poll()) or found)
    assert "it is unknown whether the action was done" in found[0].text


def test_enrolling_twice_and_odd_names_are_refused(keys, tmp_path):
    with pytest.raises(UsageError, match="enrolled there already"):
        enrol(keys, "arm")
    for name in ("", "monitor", "../arm", "a b", "-x"):
        with pytest.raises(UsageError, match="the host"):
            enrol(tmp_path, name)
    with pytest.raises(UsageError, match="--enrol"):
        read_agent(tmp_path / "none")
    with pytest.raises(UsageError, match="--enrol"):
        read_monitor(tmp_path / "none")


def test_keys_that_others_can_read_are_refused(keys, tmp_path):
    copy = tmp_path / "arm"
    shutil.copytree(keys / "arm", copy)
    (copy / "agent.pem").chmod(0o644)
    with pytest.raises(UsageError, match="chmod 600"):
        read_agent(copy)


def test_what_an_agent_gets_allows_nothing_by_itself(keys):
    from roslens.live.agent.allow_list import AllowList, read_allow_list

    assert read_allow_list(keys / "arm" / "allow.yaml") == AllowList()
