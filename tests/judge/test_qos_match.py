import pytest
from hypothesis import given
from hypothesis import strategies as st

from roslens.judge.ranges.qos_match import mismatches
from roslens.model.qos import Qos

QOS = st.builds(
    Qos,
    reliability=st.sampled_from(["", "reliable", "best_effort"]),
    durability=st.sampled_from(["", "volatile", "transient_local"]),
    liveliness=st.sampled_from(["", "automatic", "manual_by_topic"]),
    deadline_s=st.sampled_from([0.0, 0.1, 1.0]),
    lease_s=st.sampled_from([0.0, 0.1, 1.0]),
)
STRICTEST = Qos("reliable", "transient_local", liveliness="manual_by_topic", deadline_s=0.01, lease_s=0.01)


@pytest.mark.parametrize(
    ("offered", "requested", "policies"),
    [
        (Qos("best_effort"), Qos("reliable"), ["reliability"]),
        (Qos("reliable"), Qos("best_effort"), []),
        (Qos(durability="volatile"), Qos(durability="transient_local"), ["durability"]),
        (Qos(liveliness="automatic"), Qos(liveliness="manual_by_topic"), ["liveliness"]),
        (Qos(deadline_s=0.2), Qos(deadline_s=0.1), ["deadline"]),
        (Qos(), Qos(deadline_s=0.1), ["deadline"]),
        (Qos(deadline_s=0.1), Qos(deadline_s=0.1), []),
        (Qos(deadline_s=0.1), Qos(), []),
        (Qos(lease_s=2.0), Qos(lease_s=1.0), ["lease"]),
        (Qos(), Qos("reliable", "transient_local"), []),
    ],
)
def test_offers_against_requests(offered, requested, policies):
    assert [one.policy for one in mismatches(offered, requested)] == policies


@given(QOS)
def test_what_offers_itself_and_what_offers_most_fits(qos):
    assert not list(mismatches(qos, qos))
    assert not list(mismatches(STRICTEST, qos))


def test_the_words_say_what_is_lost():
    (one,) = mismatches(Qos(), Qos(deadline_s=0.1))
    assert (one.requested, one.offered, one.asks) == (
        "a deadline of 0.1 s", "no deadline", "a notification of late messages",
    )  # fmt: skip
