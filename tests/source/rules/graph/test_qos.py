from roslens.model.finding import Severity
from roslens.model.qos import Qos
from roslens.source.rules.graph.surroundings import Surroundings
from roslens.source.rules.graph.timing.qos import found
from testbed.configured import LATCHED, RELIABLE, SENSOR, configuration, end, node


def findings(*nodes):
    return list(found(configuration(*nodes), Surroundings()))


def test_a_subscription_that_gets_nothing_is_an_error_that_names_both_ends():
    (one,) = findings(
        node("/lidar", end("pub", "/scan", line=7, qos=SENSOR)),
        node("/slam", end("sub", "/scan", line=9, qos=RELIABLE)),
    )
    assert one.severity is Severity.ERROR
    assert (one.path, one.line, one.entity) == ("src/slam.cpp", 9, "topic:/scan")
    assert one.message == (
        "/slam (src/slam.cpp:9) requests reliable on /scan, /lidar (src/lidar.cpp:7) offers best_effort: it "
        "receives nothing (it requires the retransmission of lost messages). Offer reliable at the publisher or "
        "request best_effort at the subscription."
    )


def test_what_fits_or_is_unknown_is_none():
    assert not findings(
        node("/lidar", end("pub", "/scan", qos=RELIABLE)),
        node("/slam", end("sub", "/scan", qos=SENSOR)),
        node("/log", end("sub", "/scan", qos=Qos())),
        node("/view", end("sub", "/scan")),
    )


def test_a_subscription_that_others_feed_loses_one_of_them():
    (one,) = findings(
        node("/a", end("pub", "/map", qos=RELIABLE)),
        node("/b", end("pub", "/map", qos=LATCHED)),
        node("/c", end("sub", "/map", qos=LATCHED)),
    )
    assert one.severity is Severity.WARNING
    assert "/c (src/c.cpp:1) requests transient_local on /map, /a (src/a.cpp:1) offers volatile" in one.message
    assert "nothing from this publisher, but from others" in one.message


def test_one_problem_is_told_once_however_many_pairs_have_it():
    listeners = [node(f"/n{number}", end("sub", "/scan", qos=RELIABLE)) for number in range(5)]
    (one,) = findings(node("/lidar", end("pub", "/scan", qos=SENSOR)), *listeners)
    assert (
        "The same between 4 more pairs: /n1 (src/n1.cpp:1), /n2 (src/n2.cpp:1), /n3 (src/n3.cpp:1) and 1 more."
        in one.message
    )


def test_two_policies_of_one_pair_are_one_finding():
    (one,) = findings(node("/a", end("pub", "/x", qos=SENSOR)), node("/b", end("sub", "/x", qos=LATCHED)))
    assert "requests transient_local, reliable" in one.message
    assert "offers volatile, best_effort" in one.message


def test_doubt_and_conditions_lower_the_severity_and_are_told():
    (one,) = findings(
        node("/a", end("pub", "/x", qos=SENSOR, sure="likely", how="default of parameter topic", line=4)),
        node("/b", end("sub", "/x", qos=RELIABLE)),
    )
    assert one.severity is Severity.WARNING
    assert one.message.endswith("In doubt: likely only: default of parameter topic (src/a.cpp:4).")
    (one,) = findings(
        node("/a", end("pub", "/x", qos=SENSOR)), node("/b", end("sub", "/x", qos=RELIABLE, conditions=("debug",)))
    )
    assert one.severity is Severity.WARNING
    assert "only if `debug`" in one.message


def test_ends_that_never_run_together_are_no_pair():
    assert not findings(
        node("/a", end("pub", "/x", qos=SENSOR), conditions=("$(arg sim)",)),
        node("/b", end("sub", "/x", qos=RELIABLE), conditions=("not $(arg sim)",)),
    )


def test_names_that_are_not_known_raise_nothing():
    assert not findings(
        node("/a", end("pub", "/x*", qos=SENSOR, resolved=False)), node("/b", end("sub", "/x*", qos=RELIABLE))
    )


def test_a_deadline_that_may_be_offered_is_not_missed():
    asked = Qos("reliable", "volatile", "keep_last", 1, deadline_s=0.1)
    asks = node("/b", end("sub", "/x", qos=asked))
    assert len(findings(node("/a", end("pub", "/x", qos=RELIABLE)), asks)) == 1
    assert not findings(node("/a", end("pub", "/x", qos=RELIABLE, qos_unknown="argument qos")), asks)
