"""Texts that are one of very many: they stay small, and what nobody knows stays unknown."""

import msgspec

from roslens.source.extract.domain.frame import either
from roslens.source.extract.facts.launched import Setting
from roslens.source.extract.facts.node_facts import Evidence
from roslens.source.extract.facts.resolve_name import Place
from roslens.source.extract.parameters.assemble_choices import alternatives
from roslens.source.extract.parameters.assemble_parameters import Values
from roslens.source.extract.symbolic.reason import OfParameter
from roslens.source.extract.symbolic.text import IsTrue, Text, Written, unknown
from roslens.source.extract.symbolic.widening import MANY, MOST_WAYS, of_many


def chain(length, first=None):
    text = first or Text.of("the_first_of_all_names")
    for number in range(length):
        text = either(Text.of(f"another_name_{number}"), text, Written(f"the condition no. {number} > 0"))
    return text


def doubled(levels, of="name"):
    text = Text.of(of)
    for number in range(levels):
        text = either(Text.of("a/", text), Text.of("b/", text), Written(f"is_global(name) at level {number}"))
    return text


def size(text):
    return len(msgspec.json.encode(text))


def values(**given):
    place = Place(Text.of("/ns"), Text.of("/ns/node"), "ros2")
    return Values(place, tuple(Setting(Text.of(k), Text.of(v), Evidence("a.yaml", 1)) for k, v in given.items()))


def test_few_ways_stay_apart():
    text = chain(MOST_WAYS - 1)
    assert text.holes[0].choice
    assert of_many(Written("c"), Text.of("a"), Text.of("b")) is None
    assert of_many(Written("c"), chain(6), chain(6)) is None


def test_choices_in_choices_end_as_one_unknown_part():
    sizes = [size(doubled(levels)) for levels in range(2, 14)]
    assert max(sizes) < 10_000
    text = doubled(12)
    assert (text.known, text.usual) == (None, None)
    assert text.pattern == doubled(2).pattern == "*"


def test_what_decides_and_may_stand_is_said():
    text = chain(40, unknown(OfParameter("topic"), parameter="topic", default="scan"))
    reason = str(text.holes[0].reason)
    while text.holes[0].choice:
        (choice,) = text.holes[0].choice
        text = choice.otherwise
        reason = str(text.holes[0].reason)
    assert reason.startswith(MANY)
    assert "parameters topic" in reason
    assert "another_name_" in reason
    assert len(reason) < 700


def test_nothing_that_is_set_makes_one_of_many_known():
    asked = IsTrue(unknown(OfParameter("p"), parameter="p", default="true"))
    text = of_many(Written("p"), *(either(chain(5), chain(6), Written("p"), asked) for _ in range(2)))
    assert text is not None
    assert values(p="true").fill(text).text.known is None
    assert [one.text for one in alternatives(text, values(p="true"))] == [text]
    assert values(p="[a, b]").each(text) == (text,)


def test_where_many_may_stand_the_few_others_are_not_told_apart():
    many = of_many(Written("c"), chain(10), chain(10))
    assert many is not None
    asked = IsTrue(unknown(OfParameter("p"), parameter="p"))
    text = either(Text.of("scan"), many, Written("p"), asked)
    assert [one.text for one in alternatives(text, values())] == [text]
    assert [one.text for one in alternatives(text, values(p="true"))] == [Text.of("scan")]
    assert [one.text for one in alternatives(text, values(p="false"))] == [text]
