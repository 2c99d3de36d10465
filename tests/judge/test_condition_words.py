"""Conditions in words, as pages show them."""

from __future__ import annotations

import pytest

from roslens.judge.reading.read_reference import GivenText, load_reference
from roslens.judge.reference.condition_words import condition_words
from roslens.live.window.signals import BY_KEY

CASES = [
    ("{node: /lidar, is: gone}", "node /lidar is gone"),
    ("{node: /lidar, is: [gone, stopped], for: 2 s}", "node /lidar is gone or stopped, for 2 s"),
    ("{all: [{node: /a, is: gone}, {node: /b, is: gone}]}", "node /a is gone and node /b is gone"),
    (
        "{any: [{node: /a, is: gone}, {all: [{node: /b, is: gone}, {node: /c, is: gone}]}]}",
        "node /a is gone or (node /b is gone and node /c is gone)",
    ),
    ("{not: {node: /a, is: there}}", "not (node /a is there)"),
]


@pytest.mark.parametrize(("written", "words"), CASES)
def test_a_condition_is_said_in_words(written, words):
    document = f"kind: reference\nname: r\nreactions:\n  - id: one\n    when: {written}\n    do: [{{notify: hello}}]\n"
    (reaction,) = load_reference([GivenText("r.yaml", document.encode())], BY_KEY).reactions
    assert condition_words(reaction.when) == words
