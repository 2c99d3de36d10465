import pytest

from roslens.live.adapters.bag.graphs.recorded_qos import profiles_of
from roslens.model.qos import Qos

NUMBERS = """
- history: 1
  depth: 10
  reliability: 2
  durability: 1
  deadline: {sec: 0, nsec: 100000000}
  lifespan: {sec: 9223372036, nsec: 854775807}
  liveliness: 1
  liveliness_lease_duration: {sec: 2147483647, nsec: 4294967295}
"""
WORDS = "[{history: keep_all, reliability: reliable, durability: volatile, liveliness: manual_by_topic}]"


def test_profiles_in_numbers_and_in_words():
    assert profiles_of(NUMBERS) == [Qos("best_effort", "transient_local", "keep_last", 10, 0.1, 0.0, "automatic", 0.0)]
    assert profiles_of(WORDS) == [Qos("reliable", "volatile", "keep_all", liveliness="manual_by_topic")]


@pytest.mark.parametrize("text", ["", "3", "[3]", "[{", "- history: [1]\n  depth: -4\n  deadline: 3", "x" * 200_000])
def test_what_is_no_profile_is_unknown(text):
    assert all(profile == Qos() for profile in profiles_of(text))
