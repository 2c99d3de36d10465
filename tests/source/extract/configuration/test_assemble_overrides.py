"""Parameters that set the quality of service of an endpoint."""

import pytest

from roslens.model.graph import Role
from roslens.model.qos import Qos
from roslens.source.extract.configuration.assemble_overrides import Overriding
from roslens.source.extract.facts.launched import Setting
from roslens.source.extract.facts.node_facts import EndpointFact, Evidence, Overrides, Sure
from roslens.source.extract.facts.resolve_name import Place
from roslens.source.extract.parameters.assemble_parameters import Values
from roslens.source.extract.symbolic.reason import EachOf
from roslens.source.extract.symbolic.text import Text, unknown

CODE, YAML = Evidence("a.py", 3), Evidence("a.yaml", 5)
PLACE = Place(Text.of("/ns"), Text.of("/ns/node"), "ros2")
USUAL = Overrides(("history", "depth", "reliability"))
TOPIC = Text.of("/ns/scan")


def overridden(fact, topic, given, sure=Sure.CERTAIN):
    overriding = Overriding(given, shared=False)
    return overriding.take(fact, topic, sure), overriding.declared


def end(overrides, role=Role.PUBLISHER, qos=None, **others):
    qos = qos or Qos("reliable", "volatile", "keep_last", 10)
    return EndpointFact(role, Text.of("scan"), Text.of("a/msg/B"), CODE, qos=qos, overrides=overrides, **others)


def values(**given):
    settings = [Setting(Text.of(name), value, YAML, "string") for name, value in given.items()]
    return Values(PLACE, settings)


def setting(name, value):
    return values(**{name: value if isinstance(value, Text) else Text.of(value)})


def told(facts):
    return {one.name.pattern: one.default.known for one in facts}


def test_a_parameter_for_each_policy_below_the_resolved_name():
    fact, declared = overridden(end(USUAL), TOPIC, values())
    assert told(declared) == {
        "qos_overrides./ns/scan.publisher.history": "keep_last",
        "qos_overrides./ns/scan.publisher.depth": "10",
        "qos_overrides./ns/scan.publisher.reliability": "reliable",
    }
    assert {one.access for one in declared} == {"declared"}
    assert fact == end(USUAL)


def test_an_id_tells_endpoints_of_one_topic_apart():
    _, declared = overridden(end(Overrides(("depth",), "x"), Role.SUBSCRIPTION), TOPIC, values())
    assert list(told(declared)) == ["qos_overrides./ns/scan.subscription_x.depth"]


def test_a_subscription_has_no_lifespan():
    may = Overrides(("lifespan", "deadline"))
    _, declared = overridden(end(may, Role.SUBSCRIPTION), TOPIC, values())
    assert told(declared) == {"qos_overrides./ns/scan.subscription.deadline": "0"}
    _, declared = overridden(end(may), TOPIC, values())
    assert len(declared) == 2


@pytest.mark.parametrize(
    ("policy", "value", "field", "is_now"),
    [
        ("reliability", "best_effort", "reliability", "best_effort"),
        ("reliability", "system_default", "reliability", ""),
        ("history", "keep_all", "history", "keep_all"),
        ("depth", "3", "depth", 3),
        ("deadline", "500000000", "deadline_s", 0.5),
        ("deadline", str(2**63 - 1), "deadline_s", 0.0),
        ("avoid_ros_namespace_conventions", "true", "depth", 10),
    ],
)
def test_a_value_that_is_set_holds(policy, value, field, is_now):
    given = setting(f"qos_overrides./ns/scan.publisher.{policy}", value)
    fact, _ = overridden(end(Overrides((policy,))), TOPIC, given)
    assert getattr(fact.qos, field) == is_now
    assert fact.qos_unknown == ""


@pytest.mark.parametrize("value", ["often", "", "RELIABLE", unknown("argument r")])
def test_a_value_that_is_none_or_unknown_is_said(value):
    given = setting("qos_overrides./ns/scan.publisher.reliability", value)
    fact, _ = overridden(end(USUAL), TOPIC, given)
    assert (fact.qos.reliability, fact.qos.history) == ("", "keep_last")
    assert "a.yaml:5" in fact.qos_unknown


def test_what_is_set_for_another_endpoint_or_policy_says_nothing():
    for name in ("/ns/scan.subscription.depth", "/scan.publisher.depth", "/ns/scan.publisher.durability"):
        fact, _ = overridden(end(USUAL), TOPIC, setting(f"qos_overrides.{name}", "3"))
        assert fact == end(USUAL)


@pytest.mark.parametrize(
    ("overrides", "topic"),
    [
        (USUAL, Text.of("/ns/", *unknown(EachOf("them")).parts)),
        (Overrides((), "", "which is not known"), TOPIC),
        (Overrides(("reliability",), "", "", ("allow",)), TOPIC),
    ],
)
def test_in_doubt_only_what_somebody_sets_is_unknown(overrides, topic):
    fact, _ = overridden(end(overrides), topic, values())
    assert fact == end(overrides)
    fact, declared = overridden(end(overrides), topic, setting("qos_overrides./ns/scan.publisher.reliability", "a"))
    assert fact.qos.reliability == ""
    assert "qos_overrides" in fact.qos_unknown
    assert all("allow" in one.conditions for one in declared) is bool(overrides.conditions or not declared)


def test_what_the_code_gives_may_be_unknown():
    _, declared = overridden(end(USUAL, qos_unknown="its depth is unknown"), TOPIC, values())
    assert set(told(declared).values()) == {None}


def test_a_name_that_is_likely_makes_likely_parameters():
    _, declared = overridden(end(USUAL), TOPIC, values(), Sure.LIKELY)
    assert {one.evidence.sure for one in declared} == {Sure.LIKELY}


def test_services_and_other_endpoints_are_as_they_are():
    for fact in (end(USUAL, Role.SERVICE_SERVER), end(None)):
        assert overridden(fact, TOPIC, values()) == (fact, [])


OTHER = Text.of("/ns/other")
SET = "qos_overrides./ns/scan.publisher.reliability"


@pytest.mark.parametrize(("shared", "then"), [(True, ""), (False, "reliable")])
def test_rclpy_changes_a_profile_for_all_that_are_made_of_it_later(shared, then):
    overriding = Overriding(setting(SET, "best_effort"), shared=shared)
    before = overriding.take(end(None), OTHER)
    changed = overriding.take(end(USUAL), TOPIC)
    after = overriding.take(end(None, Role.SUBSCRIPTION), OTHER)
    different = overriding.take(end(None, qos=Qos("reliable", "volatile", "keep_last", 3)), OTHER)
    assert [one.qos.reliability for one in (before, changed, after, different)] == [
        "reliable", "best_effort", then, "reliable",
    ]  # fmt: skip
    assert bool(after.qos_unknown) is shared
    assert (after.qos.depth, after.qos.durability) == (10, "volatile")


def test_what_is_set_for_it_holds_again():
    overriding = Overriding(values(**{SET: Text.of("best_effort"), SET.replace("scan", "other"): Text.of("reliable")}),
                            shared=True)  # fmt: skip
    overriding.take(end(USUAL), TOPIC)
    assert overriding.take(end(USUAL), OTHER).qos.reliability == "reliable"


def test_of_several_made_at_one_place_nobody_knows_which_is_the_first():
    overriding = Overriding(setting(SET, "best_effort"), shared=True)
    first = overriding.take(end(USUAL), OTHER, looped=True)
    second = overriding.take(end(USUAL), TOPIC, looped=True)
    assert (first.qos.reliability, first.qos.history, second.qos.reliability) == ("", "keep_last", "best_effort")
    assert told(overriding.declared)["qos_overrides./ns/other.publisher.reliability"] is None
