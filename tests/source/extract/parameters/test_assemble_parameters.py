import pytest

from roslens.model.configuration import Proof
from roslens.source.extract.facts.launched import Setting
from roslens.source.extract.facts.node_facts import Evidence, ParameterFact, Sure, Terms
from roslens.source.extract.facts.resolve_name import Place
from roslens.source.extract.parameters.assemble_parameters import (
    Values,
    declared_as_set,
    doubt,
    parameters_of,
    set_outside,
)
from roslens.source.extract.symbolic.reason import EachOf, ItemOf, NamePart, OfEnvironment, OfNode, OfParameter, Reason
from roslens.source.extract.symbolic.text import Hole, Text, Written, unknown

CODE = Evidence("a.cpp", 3)
YAML = Evidence("a.yaml", 5)
TYPES = ("int", "string", "int", "")
ROS2 = Place(Text.of("/ns"), Text.of("/ns/node"), "ros2")
ROS1 = Place(Text.of("/ns"), Text.of("/ns/node"), "ros1")


def setting(name: str, value: str | Text, node: str = "") -> Setting:
    return Setting(Text.of(name), value if isinstance(value, Text) else Text.of(value), YAML, "string", node)


def hole(name: str, default: str | None = None) -> Text:
    return Text((Hole(OfParameter(str(name)), name, default),))


def test_the_last_setting_for_the_node_holds():
    values = Values(ROS2, (setting("a", "1"), setting("a", "2", "/ns/node"), setting("a", "3", "/other")))
    assert values.fill(hole("a")).text.known == "2"


def test_a_value_a_default_and_neither():
    values = Values(ROS2, (setting("a", "1"),))
    assert (values.fill(hole("a", "0")).text.known, values.fill(hole("a", "0")).sure) == ("1", Sure.CERTAIN)
    assert (values.fill(hole("b", "0")).text.known, values.fill(hole("b", "0")).sure) == ("0", Sure.LIKELY)
    assert (values.fill(hole("c")).text.pattern, values.fill(hole("c")).sure) == ("*", Sure.POSSIBLE)


def test_a_value_that_is_unknown_itself_says_why():
    filled = Values(ROS2, (setting("a", unknown(OfEnvironment("X"))),)).fill(hole("a", "0"))
    assert str(filled.text.holes[0].reason) == "environment X"
    assert filled.sure is Sure.POSSIBLE


def test_names_of_the_node_are_known():
    def filled(reason: Reason, place: Place):
        return Values(place, ()).fill(Text((Hole(reason, default="~"),))).text.known

    assert filled(OfNode(NamePart.NAME), ROS2) == "node"
    assert filled(OfNode(NamePart.FULL_NAME), ROS2) == filled(OfNode(NamePart.NAME), ROS1) == "/ns/node"
    assert filled(OfNode(NamePart.NAMESPACE), ROS2) == "/ns"


def test_parameters_of_ros1_are_compared_by_resolved_name():
    values = Values(ROS1, (setting("/ns/node/a", "1"), setting("~b", "2"), setting("/use_sim_time", "true")))
    assert values.fill(hole("~a")).text.known == "1"
    assert values.fill(hole("~/b")).text.known == "2"
    assert values.is_true("/use_sim_time")
    assert not values.is_true("/other")


def test_several_places_that_name_a_parameter_are_one():
    facts = (
        ParameterFact(Text.of("a"), Evidence("a.cpp", 9), "read"),
        ParameterFact(Text.of("a"), CODE, "declared", "int", Text.of("1"), "0..9"),
    )
    (one,) = parameters_of(facts, Values(ROS2, ()))
    assert (one.access, one.type, one.default, one.value, one.range) == ("declared", "int", "1", "1", "0..9")


def test_a_parameter_that_is_read_with_two_types_has_both():
    facts = [ParameterFact(Text.of("a"), Evidence("a.cpp", line), "declared", kind) for line, kind in enumerate(TYPES)]
    (one,) = parameters_of(facts, Values(ROS2, ()))
    assert (one.type, one.other_types) == ("int", ("string", ""))
    (one,) = parameters_of(reversed(facts[:3:2]), Values(ROS2, ()))
    assert (one.type, one.other_types) == ("int", ())


def test_doubt_is_that_of_the_least_sure():
    assert doubt(Sure.CERTAIN, Sure.POSSIBLE, Sure.LIKELY) is Sure.POSSIBLE
    assert doubt() is Sure.CERTAIN


def test_outside_of_nodes_the_last_setting_holds():
    found = list(set_outside((setting("/b", "1"), setting("/a", "2"), setting("/b", "3"))))
    assert [(one.name, one.value) for one in found] == [("/a", "2"), ("/b", "3")]


def test_a_list_stands_for_each_of_its_elements():
    each = Text.of(Hole(EachOf(OfParameter("nodes")), "nodes", "[x]"), "/state")
    values = Values(ROS2, (setting("nodes", "[a, 'b']"),))
    assert [one.known for one in values.each(each)] == ["a/state", "b/state"]
    (default,) = Values(ROS2, ()).each(each)
    assert (default.usual, Values(ROS2, ()).fill(default).sure) == ("x/state", Sure.LIKELY)
    (empty,) = Values(ROS2, (setting("nodes", "[]"),)).each(each)
    assert empty.pattern == "*/state"
    assert values.each(hole("other")) == (hole("other"),)


def test_a_global_name_stays_one_below_a_private_handle():
    values = Values(ROS1, (setting("~topic", "/odom"), setting("~near", "odom")))
    assert values.fill(Text.of("~/", hole("~topic"))).text.known == "/odom"
    assert values.fill(Text.of("~/", hole("~near"))).text.known == "~/odom"
    assert values.fill(Text.of("ns/", hole("~topic"))).text.known == "ns//odom"


def test_a_node_may_declare_whatever_is_set():
    facts = (
        ParameterFact(Text.of("a"), CODE, "read"),
        ParameterFact(Text.of("b"), CODE, "read"),
        ParameterFact(Text.of("c"), CODE, "declared", conditions=(Written("debug"),)),
    )
    values = Values(ROS2, (setting("a", "1"), setting("c", "3"), setting("d", "4")))
    made = Proof("a.py", 1)
    found = declared_as_set(parameters_of(facts, values), made)
    assert {one.name: (one.access, one.value, one.conditions) for one in found} == {
        "a": ("declared", "1", ()), "b": ("read", None, ()), "c": ("declared", "3", ()), "d": ("declared", "4", ()),
    }  # fmt: skip
    assert [one.proof.line for one in found if one.proof] == [3, 3, 3, 1]


def each(reason: Reason, default: str | None = None) -> Text:
    return Text.of("t/", Hole(reason, "names", default))


def names_of(values: Values, text: Text) -> list[tuple[str, Sure]]:
    found = [values.fill(one) for one in values.each(text)]
    return [(one.text.pattern, one.sure) for one in found]


def test_names_out_of_a_list_that_is_set_or_declared():
    values = Values(ROS2, (setting("names", "[a, 'b']"),))
    assert names_of(values, each(EachOf(OfParameter("names")), "[c]")) == [("t/a", Sure.CERTAIN), ("t/b", Sure.CERTAIN)]
    none = Values(ROS2, ())
    assert names_of(none, each(EachOf(OfParameter("names")), "[c, d]")) == [("t/c", Sure.LIKELY), ("t/d", Sure.LIKELY)]
    assert names_of(none, each(EachOf(OfParameter("names")))) == [("t/*", Sure.POSSIBLE)]


def test_an_empty_list_gives_no_name():
    values = Values(ROS2, (setting("names", "[]"),))
    assert names_of(values, each(EachOf(OfParameter("names")), "[c]")) == [("t/*", Sure.POSSIBLE)]


def test_a_list_that_is_set_to_what_is_unknown():
    values = Values(ROS2, (setting("names", unknown("argument names")),))
    assert names_of(values, each(EachOf(OfParameter("names")), "[c]")) == [("t/*", Sure.POSSIBLE)]


def test_one_item_of_a_list():
    values = Values(ROS2, (setting("names", "[a, b]"),))
    assert names_of(values, each(ItemOf(1, OfParameter("names")))) == [("t/b", Sure.CERTAIN)]
    assert names_of(values, each(ItemOf(-1, OfParameter("names")))) == [("t/b", Sure.CERTAIN)]
    assert names_of(values, each(ItemOf(-2, OfParameter("names")))) == [("t/a", Sure.CERTAIN)]
    assert names_of(values, each(ItemOf(2, OfParameter("names")))) == [("t/*", Sure.POSSIBLE)]


@pytest.mark.parametrize(
    "reason",
    [
        EachOf("a part of {parameter names}"),
        EachOf(EachOf(OfParameter("names"))),
        "result of f() of {parameter names}",
    ],
)
def test_what_is_made_of_a_list_is_no_item_of_it(reason):
    values = Values(ROS2, (setting("names", "[a, b]"),))
    assert names_of(values, each(reason)) == [("t/*", Sure.POSSIBLE)]


def test_parameters_that_a_list_names():
    facts = (ParameterFact(Text.of(Hole(EachOf(OfParameter("names")), "names", "[a, b]"), ".rate"), CODE, "declared"),)
    assert [one.name for one in parameters_of(facts, Values(ROS2, ()))] == ["a.rate", "b.rate"]
    assert [one.name for one in parameters_of(facts, Values(ROS2, (setting("names", "[c]"),)))] == ["c.rate", "names"]


def test_topics_that_parameters_tell_which_a_list_names():
    name = Text.of(Hole(EachOf(OfParameter("names")), "names", among="[a, b]"), ".topic")
    topic = Text.of(Hole(OfParameter(str(name)), "*.topic", named=(name,)))
    values = Values(ROS2, (setting("a.topic", "/scan"), setting("names", "[a]")))
    assert names_of(values, topic) == [("/scan", Sure.CERTAIN)]
    assert names_of(Values(ROS2, (setting("b.topic", "/odom"),)), topic) == [
        ("*", Sure.POSSIBLE),
        ("/odom", Sure.CERTAIN),
    ]


def test_defaults_of_parameters_that_a_list_names():
    item = Hole(EachOf(OfParameter("names")), "names", among="[a, b]")
    fact = ParameterFact(Text.of(item, ".topic"), CODE, "declared", "string", Text.of(item, "/scan"))
    found = parameters_of((fact,), Values(ROS2, ()))
    assert [(one.name, one.default) for one in found] == [("a.topic", "a/scan"), ("b.topic", "b/scan")]


@pytest.mark.parametrize(
    ("name", "settings", "expected"),
    [
        (Text.of("a"), (), ("a", "certain", "")),
        (Text.of(hole("p", "x"), ".a"), (), ("x.a", "likely", "default of parameter p")),
        (Text.of(hole("p"), ".a"), (), ("*.a", "possible", "parameter p")),
        (
            Text.of(hole("p", "x"), ".a"),
            (setting("p", "y"),),
            ("y.a", "certain", "parameter p, set in a.yaml:5"),
        ),
    ],
)
def test_a_parameter_is_as_sure_as_its_name(name, settings, expected):
    found = parameters_of((ParameterFact(name, CODE, "declared"),), Values(ROS2, settings))
    (one,) = [one for one in found if one.access]
    assert (one.name, one.proof.sure, one.proof.how) == expected


def test_what_a_declaration_says_is_kept_from_where_it_is_said():
    facts = (
        ParameterFact(Text.of("a"), CODE, "read", "double"),
        ParameterFact(
            Text.of("a"), Evidence("b.cpp", 4), "declared", "list", range="0..1", description="what",
            terms=Terms(read_only=True, allowed=("1",)),
        ),
    )  # fmt: skip
    (one,) = parameters_of(facts, Values(ROS2, ()))
    assert (one.type, one.range, one.description, one.read_only, one.allowed) == (
        "double",
        "0..1",
        "what",
        True,
        ("1",),
    )
