import pytest

from roslens.live.system import misfit as fit
from roslens.live.system.misfit import MOST_PAIRS, incompatible, misfits, misfits_by_topic
from roslens.model.graph import Endpoint, Role
from roslens.model.qos import Qos


def end(role, qos=None, node="/n", kind="a/msg/B", type_hash=""):
    return Endpoint(node, role, "/t", kind, type_hash, qos)


@pytest.mark.parametrize(
    ("offered", "requested", "words"),
    [
        (Qos("best_effort"), Qos("reliable"), [("reliable", "best_effort")]),
        (Qos("reliable"), Qos("best_effort"), []),
        (Qos(durability="volatile"), Qos(durability="transient_local"), [("transient_local", "volatile")]),
        (Qos(liveliness="automatic"), Qos(liveliness="manual_by_topic"), [("manual_by_topic", "automatic")]),
        (Qos(deadline_s=0.2), Qos(deadline_s=0.1), [("a deadline of 0.1 s", "one of 0.2 s")]),
        (Qos(), Qos(deadline_s=0.1), [("a deadline of 0.1 s", "no deadline")]),
        (Qos(deadline_s=0.1), Qos(deadline_s=0.1), []),
        (Qos(lease_s=5), Qos(lease_s=1), [("a lease of 1 s", "one of 5 s")]),
        (Qos(), Qos("reliable", "transient_local"), []),
    ],
)
def test_what_is_requested_must_be_offered(offered, requested, words):
    assert list(incompatible(offered, requested)) == words


def test_a_pair_that_exchanges_nothing_is_named_once_with_its_reason():
    ends = [end(Role.PUBLISHER, Qos("best_effort"), "/camera"), end(Role.SUBSCRIPTION, Qos("reliable"), "/viewer")]
    (failure,) = misfits(ends * 2)
    assert str(failure) == (
        "topic:/t: /viewer gets nothing of what /camera publishes on /t: it requests reliable; expected a request that "
        "is met by what is offered, best_effort. Offer more at the publisher or request less at the subscription"
    )


def test_another_definition_of_the_same_type_is_named():
    (failure,) = misfits([end(Role.PUBLISHER, type_hash="RIHS01_aa"), end(Role.SUBSCRIPTION, type_hash="RIHS01_bb")])
    assert "its definition of a/msg/B is another (RIHS01_bb)" in failure.what


def test_another_type_is_named():
    (failure,) = misfits([end(Role.PUBLISHER), end(Role.SUBSCRIPTION, kind="a/msg/C")])
    assert "its type is a/msg/C" in failure.what


def test_publishers_of_several_types_are_named_where_nobody_subscribes():
    ends = [end(Role.PUBLISHER, node="/a"), end(Role.PUBLISHER, node="/b", kind="a/msg/C"), end(Role.PUBLISHER)]
    (failure,) = misfits(ends)
    assert failure.what == "/a and /b publish different types on /t: a/msg/B and a/msg/C"
    assert misfits_by_topic(ends) == {"/t": 1}


def test_a_subscription_shows_which_of_several_types_is_wrong():
    ends = [end(Role.PUBLISHER, node="/a"), end(Role.PUBLISHER, node="/b", kind="a/msg/C"), end(Role.SUBSCRIPTION)]
    assert [one.what for one in misfits(ends)] == ["/n gets nothing of what /b publishes on /t: its type is a/msg/B"]


def test_publishers_whose_types_are_unknown_are_no_failure():
    assert list(misfits([end(Role.PUBLISHER, node="/a"), end(Role.PUBLISHER, node="/b", kind="")])) == []


def test_what_fits_or_is_unknown_is_no_failure():
    assert list(misfits([end(Role.PUBLISHER), end(Role.SUBSCRIPTION, Qos("reliable"))])) == []


def test_many_ends_are_compared_by_kind_and_many_misfits_are_bounded(monkeypatch):
    compared = []
    inner = fit._misfit
    monkeypatch.setattr(fit, "_misfit", lambda *ends: compared.append(ends) or inner(*ends))
    publishers = [end(Role.PUBLISHER, Qos("reliable"), f"/p{number}") for number in range(200)]
    subscriptions = [end(Role.SUBSCRIPTION, Qos("reliable"), f"/s{number}") for number in range(200)]
    assert list(misfits([*publishers, *subscriptions])) == []
    assert len(compared) == 1
    lax = [end(Role.PUBLISHER, Qos("best_effort"), f"/p{number}") for number in range(200)]
    assert len(list(misfits([*lax, *subscriptions]))) == MOST_PAIRS
