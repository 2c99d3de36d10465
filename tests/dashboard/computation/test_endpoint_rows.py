"""Endpoints in words."""

from __future__ import annotations

import msgspec

from roslens.dashboard.computation.endpoint_rows import conditions_cell, notes, policies, qos_text
from roslens.model.configuration import ConfiguredEndpoint, Origin, Proof
from roslens.model.graph import Endpoint, Role
from roslens.model.qos import Qos

ONE = ConfiguredEndpoint(Endpoint("/n", Role.PUBLISHER, "/t"), Proof("a.cpp", 3))


def test_policies_are_words() -> None:
    assert policies(Qos("reliable", "transient_local", "keep_last", 1)) == "reliable, transient local, keep last 1"
    assert policies(Qos("", "", "keep_all", 7, deadline_s=0.5)) == "keep all, deadline 0.5 s"
    assert policies(Qos(liveliness="manual_by_topic", lease_s=2)) == "lease 2 s, liveliness manual by topic"


def test_ros1_has_queues() -> None:
    assert qos_text(msgspec.structs.replace(ONE, queue=10, latched=True)) == "queue 10, latched"
    assert qos_text(msgspec.structs.replace(ONE, qos_unknown="a parameter")) == "a parameter"


def test_notes_say_where_a_fact_that_is_not_code_comes_from() -> None:
    known = msgspec.structs.replace(ONE, proof=Proof("a", origin=Origin.CATALOGUE), group="slow")
    assert notes(known) == "callback group slow; known of this package"
    assert notes(ONE) == ""


def test_many_conditions_are_cut_but_for_the_hint_and_the_twin() -> None:
    few = conditions_cell(("a", "b"))
    assert (few.value, few.text, few.hint) == ("a and b", "", "")
    many = conditions_cell(tuple(f"condition_{number}" for number in range(40)))
    assert isinstance(many.value, str)
    assert many.value.endswith("condition_39")
    assert many.hint == many.value
    assert many.text.endswith("…")
    assert len(many.text) <= 100
