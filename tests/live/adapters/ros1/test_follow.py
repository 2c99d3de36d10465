import pytest

from roslens.live.adapters.ros1.follow import Follower
from roslens.live.adapters.ros1.master import Master
from roslens.live.adapters.ros1.names import observer_name
from roslens.live.adapters.ros1.resolve import Resolver

pytestmark = pytest.mark.timed

ME, API = "/me", "http://127.0.0.1:9/"
PUBLISHED = (("/diagnostics", "diagnostic_msgs/DiagnosticArray"), ("/rated", "roslens_msgs/RatedSignals"))


@pytest.fixture
def published(system):
    """Publishers as the master was notified of them."""
    reported = []

    def answer():
        ok = [1, "", []]

        def register(caller, topic, type_, uri):
            reported.append(("register", topic, type_, uri))
            system.publishers.setdefault(topic, set()).add(caller)
            return ok

        def unregister(caller, topic, uri):
            reported.append(("unregister", topic, uri))
            system.publishers[topic].discard(caller)
            return [1, "", 1]

        system.master.answers.update({"registerPublisher": register, "unregisterPublisher": unregister})

    system.answer = answer
    answer()
    return reported


def test_what_is_published_is_registered_is_no_part_of_the_system_and_is_taken_back(system, published):
    follower = Follower(Master(system.master.uri, ME, Resolver()), ME, API, PUBLISHED)
    follower.step()
    follower.step()
    assert published == [("register", topic, type_, API) for topic, type_ in PUBLISHED]
    assert follower.state.publishers == ()
    follower.leave(lambda _: None)
    assert published[2:] == [("unregister", topic, API) for topic, _ in PUBLISHED]


def test_it_is_registered_at_a_master_that_was_restarted(system, published):
    follower = Follower(Master(system.master.uri, ME, Resolver()), ME, API, PUBLISHED)
    follower.step()
    port = system.master.port
    system.master.close()
    follower.step()
    system.pid, system.publishers, system.subscribers = 101, {}, {}
    system.start(port)
    system.answer()
    assert follower.step().restarted
    assert [reported[:2] for reported in published] == [("register", topic) for topic, _ in PUBLISHED] * 2
    follower.leave(lambda _: None)


def test_other_observers_are_no_part_of_the_system(system, published):
    system.publishers = {"/diagnostics": {observer_name("base-1", 7), "/arm"}, "/chat": {"/roslens_demo"}}
    system.subscribers = {"/chat": {observer_name("brain", 12)}}
    follower = Follower(Master(system.master.uri, ME, Resolver()), ME, API, ())
    follower.step()
    assert follower.state.publishers == (("/chat", "/roslens_demo"), ("/diagnostics", "/arm"))
    assert follower.state.subscribers == ()
    follower.leave(lambda _: None)
