from roslens.model.configuration import Proof
from roslens.model.finding import Severity
from roslens.source.rules.graph.surroundings import Surroundings, Wait
from roslens.source.rules.graph.timing.deadlock import found
from testbed.configured import configuration, end, node, timer

SITE = Proof("src/a.py", 30)
WAITS = (Wait("Driver.on_goal", SITE),)


def findings(*, group="", own="", callback="Driver.on_goal", waits=WAITS, generation="ros2"):
    client = end("call", "/load", "m/srv/Load", 10, sites=(SITE,), group=group)
    listener = end("sub", "/goal", callback=callback, group=own)
    return list(found(configuration(node("/a", client, listener), generation=generation), Surroundings(waits=waits)))


def test_a_callback_that_waits_in_the_group_of_its_client_is_told():
    (one,) = findings()
    assert (one.severity, one.path, one.line) == (Severity.ERROR, "src/a.py", 30)
    assert one.message == (
        "Driver.on_goal of /a waits (call(), src/a.py:30) for service /load, whose client (src/a.cpp:10) is in the "
        "default group as the callback itself: the answer is never taken. Give the client a callback group of its own."
    )


def test_a_group_that_both_are_given_is_one_too():
    assert len(findings(group="MutuallyExclusive:5", own="MutuallyExclusive:5")) == 1


def test_other_groups_other_functions_and_no_wait_are_none():
    assert not findings(group="MutuallyExclusive:5")
    assert not findings(group="Reentrant:5", own="Reentrant:5")
    assert not findings(callback="Driver.on_scan")
    assert not findings(waits=())
    assert not findings(generation="ros1")


def test_a_timer_calls_back_too():
    client = end("call", "/load", "m/srv/Load", 10, sites=(SITE,))
    known = configuration(node("/a", client, timers=(timer(1.0, "Driver::on_goal"),)))
    assert len(list(found(known, Surroundings(waits=WAITS)))) == 1
