"""Heavy calls that made nothing are followed once; others each time."""

import pytest

from roslens.source.extract.domain.abstract_value import Obj, Unknown
from roslens.source.extract.domain.frame import Frame
from roslens.source.extract.domain.summaries import Summaries, Summary
from roslens.source.extract.facts.node_facts import Evidence
from roslens.source.extract.interpreter.functions import Functions
from roslens.source.extract.ir.program import Assign, Function, Literal, Name
from roslens.source.extract.symbolic.text import Text

KEY, OUTER = ("a.cpp", 1), ("a.cpp", 9)
HEAVY = "\n".join(f"write(level_ + {number});" for number in range(30))


@pytest.fixture
def followed(monkeypatch):
    """Return the names of functions whose body was followed, in order."""
    names = []
    original = Functions._followed

    def counted(self, call, *rest):
        names.append(call.function.function.name)
        return original(self, call, *rest)

    monkeypatch.setattr(Functions, "_followed", counted)
    return names


def done(thing=None, arguments=(), templates=(), depth=1, before=None, cuts=(), body=()):
    function, frame = Function("f", "f", 1, body=body), Frame("a.cpp", "f")
    return Summary(
        function, thing, (list(arguments), templates), depth, frame, before or {}, set(cuts), Evidence("", 0)
    )


def fits(one, thing=None, arguments=(), templates=(), stack=(OUTER,)):
    return one.fits(thing, (list(arguments), templates), list(stack))


def test_equal_values_on_the_same_object_fit():
    thing = Obj("A")
    one = done(thing, [Text.of("x"), Unknown("why")])
    assert fits(one, thing, [Text.of("x"), Unknown("another reason")])
    assert not fits(one, thing, [Text.of("y"), Unknown("why")])
    assert not fits(one, thing, [Text.of("x"), Text.of("known")])
    assert not fits(one, thing, [Text.of("x")])
    assert not fits(one, Obj("A"), [Text.of("x"), Unknown("why")])


def test_one_and_true_are_not_equal():
    assert not fits(done(arguments=[1]), arguments=[True])


def test_template_arguments_have_to_be_equal():
    assert fits(done(templates=("A",)), templates=("A",))
    assert not fits(done(templates=("A",)), templates=("B",))


def test_a_call_nearer_to_the_start_is_followed_further():
    assert not fits(done(depth=2), stack=[OUTER])
    assert fits(done(depth=2), stack=[OUTER, KEY])


def test_what_was_cut_short_by_a_call_around_does_not_hold_without_that_call():
    one = done(cuts=[OUTER])
    assert fits(one, stack=[OUTER])
    assert not fits(one, stack=[KEY])


def test_fields_are_those_that_changed_or_are_assigned():
    thing = Obj("A", None, {"same": 1, "new": 2, "changed": 3, "set": 4})
    body = (Assign(Name("set"), Literal(4)),)
    found = done(thing, before={"same": 1, "changed": 4, "set": 4}, body=body).fields
    assert found == {"new": 2, "changed": 3, "set": 4}


def test_what_was_cut_is_handed_on():
    summaries = Summaries()
    summaries.keep(KEY, done(cuts=[OUTER]))
    assert summaries.known(KEY, None, ([], ()), [OUTER]) is not None
    assert summaries.cuts == {OUTER}
    assert summaries.known(OUTER, None, ([], ()), [OUTER]) is None


def test_a_heavy_call_that_makes_nothing_is_followed_once(node_of, followed):
    members = f'void fill() {{ {HEAVY} topic_ = "filled"; }} int level_; std::string topic_;'
    body = 'fill();\ntopic_ = "empty";\nfill();\npub_ = create_publisher<std_msgs::msg::String>(topic_, 1);'
    (one,) = node_of(body, members).endpoints
    assert followed.count("fill") == 1
    assert one.name.known == "filled"


def test_what_makes_an_endpoint_is_followed_each_time(node_of, followed):
    members = (
        f"void fill(int n) {{ {HEAVY} pub_ = create_publisher<std_msgs::msg::String>(names_[n], 1); }} int level_;"
    )
    node_of("fill(1);\nfill(1);", members)
    assert followed.count("fill") == 2


def test_a_callback_that_is_given_away_again_counts_once(node_of, followed):
    members = (
        f"void fill() {{ {HEAVY} later(std::bind(&A::heard, this)); }} int level_;"
        'void heard() { pub_ = create_publisher<std_msgs::msg::String>("out", 1); }'
    )
    facts = node_of("fill();\nheard();\nfill();\nfill();", members)
    assert [str(one.name) for one in facts.endpoints] == ["out"]
    assert followed.count("fill") == 2
    assert followed.count("heard") == 1


def test_a_short_call_is_followed_each_time(node_of, followed):
    node_of("fill();\nfill();", "void fill() { write(level_); } int level_;")
    assert followed.count("fill") == 2


def test_a_call_that_sets_what_all_functions_see_sets_it_each_time(node_of):
    before = 'std::string topic = "a";'
    members = f'void fill() {{ {HEAVY} topic = "filled"; write(level_); }} int level_;'
    body = 'fill();\ntopic = "empty";\nfill();\npub_ = create_publisher<std_msgs::msg::String>(topic, 1);'
    (one,) = node_of(body, members, before).endpoints
    assert one.name.known == "filled"


def test_a_call_sees_what_all_functions_see_now(node_of):
    members = f'std::string named() {{ {HEAVY} return "of_" + topic; }} int level_;'
    body = 'named();\ntopic = "b";\npub_ = create_publisher<std_msgs::msg::String>(named(), 1);'
    (one,) = node_of(body, members, 'std::string topic = "a";').endpoints
    assert one.name.known == "of_b"


def test_a_call_sees_what_its_object_holds_now(node_of):
    members = f'std::string named() {{ {HEAVY} return "of_" + topic_; }} int level_; std::string topic_ = "a";'
    body = 'named();\ntopic_ = "b";\npub_ = create_publisher<std_msgs::msg::String>(named(), 1);'
    (one,) = node_of(body, members).endpoints
    assert one.name.known == "of_b"


def test_overrides_keep_the_conditions_of_each_call(node_of):
    members = (
        f"rclcpp::PublisherOptions options() {{ {HEAVY} rclcpp::PublisherOptions o;"
        " o.qos_overriding_options = rclcpp::QosOverridingOptions::with_default_policies(); return o; } int level_;"
    )
    body = 'if (far()) { options(); }\nauto o = options();\npub_ = create_publisher<std_msgs::msg::String>("a", 1, o);'
    (one,) = node_of(body, members).endpoints
    assert one.overrides.policies
    assert not one.overrides.conditions
