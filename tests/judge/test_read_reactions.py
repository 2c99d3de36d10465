"""Reactions as documents write them, and what is refused of them, each with its place."""

import pytest

from roslens.judge.reading.read_reference import GivenText, load_reference
from roslens.live.window.signals import BY_KEY
from roslens.model.acting.condition import About, AllOf, AnyOf, AtLeast, Matching, Not, OverTime, Stated
from roslens.model.acting.reaction import ActionCall, EscalationStep, Mode
from roslens.model.entity import EntityId, EntityKind
from roslens.model.errors import DocumentError
from roslens.model.finding import Severity
from roslens.model.selector import Selector

HEAD = "kind: reference\nname: robot\n"


def load(*texts: str):
    return load_reference([GivenText(f"r{n}.yaml", text.encode()) for n, text in enumerate(texts)], BY_KEY)


def reactions(text: str):
    return load(HEAD + text).reactions


def one(when: str, do: str = "[{snapshot: {}}]", rest: str = ""):
    (found,) = reactions(f"reactions:\n- {{id: a, when: {when}, do: {do}{rest}}}\n")
    return found


def refused(text: str, *more: str) -> str:
    with pytest.raises(DocumentError) as error:
        load(HEAD + text, *more)
    return str(error.value)


def refused_one(when: str, do: str = "[{snapshot: {}}]", rest: str = "") -> str:
    return refused(f"reactions:\n- id: a\n  when: {when}\n  do: {do}\n{rest}")


def test_everything_a_reaction_may_say():
    (found,) = reactions("""
reactions:
- id: lidar
  text: "{entity} is {state}"
  when:
    all:
    - {node: /lidar*, is: [absent, low], signal: presence, severity: error, match: each, for: 2 s}
    - {topic: /scan, is: bad, effects: true, unknown: false}
    - at_least: 2
      among: [{host: a, is: ok}, {host: b, is: ok}, {parameter: /base/speed, value: 0.2..0.5}]
      within: 5 s
      of: {node: /base, lifecycle: active}
    after_start: 1 min
  only_while: {parameter: /base/mode, value: [auto, 1]}
  unless: {not: {any: [{node: /x, is: there}, {topic: /y, is: misfit}]}}
  settled: 500 ms
  cool_down: 2 min
  at_most: 3 per 10 min
  mode: ask
  do:
  - notify: "{entity} on {host}"
  - restart: {node: "{entity}", grace: 3 s}
    verify: 10 s
  - publish: {topic: /stop, type: std_msgs/msg/Bool, fields: {data: true, note: ["{cause}", 1, 2.5, null, "yes"]}}
  - stop: base
""")
    lidar = Stated(
        Selector(EntityKind.NODE, "/lidar*"),
        states=("absent", "low"),
        quantity="presence",
        severity=Severity.ERROR,
        matching=Matching.EACH,
        time=OverTime(for_s=2),
        place="r0.yaml:9:8",
        written="node /lidar* is absent or low (presence)",
    )
    assert isinstance(found.when, AllOf)
    first, second, third = found.when.parts
    assert first == lidar
    assert (second.effects, second.unknown, second.written) == (True, False, "topic /scan is bad")
    assert isinstance(third, AtLeast)
    assert (third.count, third.time.within_s, third.time.of.about) == (2, 5, About.LIFECYCLE)
    assert (third.parts[2].least, third.parts[2].most, third.parts[2].states) == (0.2, 0.5, ())
    assert found.when.time == OverTime(after_start_s=60)
    assert found.only_while.states == ("auto", "1")
    assert isinstance(found.unless, Not)
    assert isinstance(found.unless.part, AnyOf)
    assert (found.name, found.settled_s, found.cool_down_s, found.at_most, found.per_s) == (
        "robot.lidar",
        0.5,
        120,
        3,
        600,
    )
    assert (found.mode, found.place) == (Mode.ASK, "r0.yaml:5:3")
    notify, restart, publish, stop = found.steps
    assert notify == EscalationStep(ActionCall("notify", None, {"text": "{entity} on {host}"}, "r0.yaml:23:5"))
    assert restart.verify_within_s == 10
    assert restart.action.target == EntityId(EntityKind.NODE, "{entity}")
    assert restart.action.arguments == {"grace": 3.0}
    assert publish.action.arguments["fields"] == {"data": True, "note": ["{cause}", 1, 2.5, None, "yes"]}
    assert stop.action.target == EntityId(EntityKind.NODE, "/base")


def test_a_condition_by_its_name_and_one_that_only_waits():
    (found,) = reactions("""
conditions:
- {id: gone, when: {node: /lidar, is: gone}}
- {id: both, when: {all: [{condition: gone}, {host: a, is: ok}]}}
reactions:
- {id: a, when: {condition: both, for: 3 s}, do: [{snapshot: {}}]}
""")
    assert isinstance(found.when, AllOf)
    assert found.when.time.for_s == 3
    assert found.when.parts[0].parts[0].written == "node /lidar is gone"


def test_a_later_document_replaces_a_reaction_in_so_many_words():
    base = HEAD + "reactions: [{id: a, when: {node: /x, is: gone}, do: [{restart: /x}]}]"
    site = (
        "kind: reference\nname: site\nreactions: [{id: a, override: true, when: {host: b, is: gone}, do: [{stop: /x}]}]"
    )
    (found,) = load(base, site).reactions
    assert (found.name, found.steps[0].action.kind) == ("robot.a", "stop")


GONE = "{node: /x, is: gone}"
EACH = "{node: /x*, is: gone, match: each}"


@pytest.mark.parametrize(
    ("when", "do", "said"),
    [
        ("{}", "[{snapshot: {}}]", "r0.yaml:5:9: a condition that states nothing; expected one of all, any, not"),
        ("{node: /x}", "[{snapshot: {}}]", "a condition that does not mention node /x; expected one of `is`"),
        ("{node: /x, is: absnt}", "[{snapshot: {}}]", "5:24: is is 'absnt'; expected one of ok, suspended"),
        ("{node: /x, is: misfit}", "[{snapshot: {}}]", "is is 'misfit'"),
        ("{node: /x, is: [gone, low]}", "[{snapshot: {}}]", "'low' beside 'gone'"),
        ("{node: /x, is: gone, severity: error}", "[{snapshot: {}}]", "'severity' beside is: gone"),
        ("{node: /x, lifecycle: actve}", "[{snapshot: {}}]", "lifecycle is 'actve'"),
        ("{topic: /x, value: 1}", "[{snapshot: {}}]", "'value' of a topic; expected it of a parameter"),
        ("{topic: /x, is: bad, signal: rat}", "[{snapshot: {}}]", "signal is 'rat'"),
        ("{topic: /x, is: bad, signal: cpu}", "[{snapshot: {}}]", "'cpu' is not measured of a topic"),
        ("{all: []}", "[{snapshot: {}}]", "'all' of no condition"),
        (f"{{all: [{GONE}], is: gone}}", "[{snapshot: {}}]", "'is' beside 'all'"),
        (f"{{all: [{GONE}], not: {GONE}}}", "[{snapshot: {}}]", "'not' beside 'all'"),
        (f"{{at_least: 2, among: [{GONE}]}}", "[{snapshot: {}}]", "at_least is '2'; expected a whole number from 1"),
        ("{node: /x, is: gone, within: 5 s}", "[{snapshot: {}}]", "'within' without 'of'"),
        ("{node: /x, is: gone, for: -1 s}", "[{snapshot: {}}]", "for is '-1 s'; expected a time from 0 on"),
        ("{node: /x, is: gone, for: 5 Hz}", "[{snapshot: {}}]", "for: 5 Hz"),
        ("{condition: y}", "[{snapshot: {}}]", "5:21: no condition 'y'; expected a condition listed under"),
        (GONE, "[{explode: {}}]", "unknown key 'explode' of a step"),
        (GONE, "[{}]", "a step without an action"),
        (GONE, "[{stop: /x, start: /x}]", "'start' beside 'stop'"),
        (GONE, "[]", "reaction 'a' with 0 actions"),
        (GONE, "[{restart: {}}]", "6:18: `restart` with no target; expected `node: NAME`"),
        (GONE, "[{restart: /x*}]", "restart '/x*' has wildcards; expected the name of one node. To act on each"),
        (GONE, "[{restart: {node: /x, gracee: 1 s}}]", "unknown key 'gracee' of a `restart`"),
        (GONE, "[{restart: {node: /x, grace: soon}}]", "grace: 'soon' is not an amount"),
        (GONE, "[{restart: {node: /x, whole_process: 1}}]", "whole_process is '1'; expected true or false"),
        (GONE, "[{publish: {topic: /stop}}]", "`publish` without 'type'; expected the line `type: …`"),
        (GONE, "[{publish: {topic: stop, type: std_msgs/Bool}}]", "topic is 'stop'; expected a name that begins"),
        (GONE, "[{publish: {topic: /stop, type: Bool}}]", "type is 'Bool'; expected `package/Type`"),
        (GONE, "[{publish: {topic: /s, type: a/B, fields: {x: '{why}'}}}]", "fields: unknown field '{why}'"),
        (GONE, "[{notify: 'lost {entty}'}]", "unknown field '{entty}'; expected one of {entity}, {kind}"),
        (GONE, "[{notify: 'a } b'}]", "a single brace; expected `}}`"),
        (GONE, "[{notify: {text: a, level: bad}}]", "level is 'bad'; expected one of info, warning, error"),
        (GONE, "[{lifecycle: /x}]", "lifecycle is '/x'; expected a table with `node`, `transition`"),
        (GONE, "[{restart: '{value}'}]", "restart is '{value}'; expected `{entity}`, `{host}`, `{cause}` or a name"),
        (GONE, "[{restart: '{host}'}]", "restart is '{host}', which is a host; expected a node"),
        ("{node: /x*, is: gone}", "[{restart: '{entity}'}]", "'{entity}' of a reaction that is not about one entity"),
        ("{topic: /x, is: absent}", "[{restart: '{entity}'}]", "'{entity}' is a topic; expected a node"),
        ("{topic: /x, is: absent}", "[{command: {host: '{host}', name: a}}]", "'{host}' of a topic"),
        (f"{{all: [{EACH}, {{topic: /*, is: bad, match: each}}]}}", "[{snapshot: {}}]", "a second `match: each`"),
        (f"{{not: {EACH}}}", "[{snapshot: {}}]", "`match: each` of what is not asked to be true"),
        (f"{{all: [{GONE}, {{not: {GONE}}}]}}", "[{snapshot: {}}]", "the reaction can never begin"),
        (f"{{all: [{GONE}, {{node: /x, is: stopped}}]}}", "[{snapshot: {}}]", "5:39: 'node /x is stopped' and 'node"),
        ("{all: [{node: /x, lifecycle: active}, {node: /x, lifecycle: inactive}]}", "[{snapshot: {}}]", "never begin"),
        ("{all: [{node: /x, is: ok}, {node: /x, is: bad}]}", "[{snapshot: {}}]", "never begin"),
        ("{all: [{topic: /x, is: low, signal: rate}, {topic: /x, is: high, signal: rate}]}", "[{stop: /x}]", "never"),
        (f"{{any: [{GONE}, {{not: {GONE}}}]}}", "[{snapshot: {}}]", "5:45: `when` is true whatever happens"),
        (f"{GONE}\n  only_while: {{any: [{{not: {GONE}}}, {GONE}]}}", "[{stop: /x}]", "`only_while` is true"),
        (f"{GONE}\n  unless: {{any: [{{host: a, is: bad}}, {{not: {{host: a, is: bad}}}}]}}", "[{stop: /x}]", "never"),
        (f"{GONE}\n  only_while: {{not: {GONE}}}", "[{snapshot: {}}]", "never begin"),
        (f"{GONE}\n  unless: {{any: [{{host: a, is: bad}}, {GONE}]}}", "[{snapshot: {}}]", "never begin"),
    ],
)  # fmt: skip
def test_what_is_wrong_with_a_reaction(when, do, said):
    message = refused_one(when, do)
    assert said in message
    assert message.startswith("r0.yaml:")


@pytest.mark.parametrize(
    "when",
    [
        "{all: [{topic: /x, is: low}, {topic: /x, is: high}]}",
        "{all: [{node: /x*, is: gone}, {node: /x*, is: there}]}",
        f"{{all: [{GONE}, {{not: {{node: /x, is: gone, for: 5 s}}}}]}}",
        f"{{all: [{GONE}, {{node: /y, is: there}}]}}",
    ],
)
def test_what_can_be_true_together_is_taken(when):
    assert one(when).name == "robot.a"


@pytest.mark.parametrize(("text", "count", "per_s"), [("3 per 10 min", 3, 600.0), ("1 per h", 1, 3600.0)])
def test_how_often_at_most(text, count, per_s):
    found = one(GONE, rest=f", at_most: {text}")
    assert (found.at_most, found.per_s) == (count, per_s)


@pytest.mark.parametrize("text", ["often", "0 per min", "3 per 0 s", "-1 per min", "3", "3 per 5 Hz", "1.5 per min"])
def test_how_often_needs_a_number_and_a_time(text):
    assert "at_most" in refused_one(GONE, rest=f"  at_most: {text}")


def test_a_circle_of_conditions():
    text = """
conditions:
- {id: a, when: {any: [{condition: b}, {node: /x, is: gone}]}}
- {id: b, when: {not: {condition: a}}}
"""
    assert refused(text) == (
        "r0.yaml:6:35: condition 'a' is about itself: a → b → a; expected conditions without a circle"
    )


def test_two_reactions_of_one_name():
    row = "- {id: a, when: {node: /x, is: gone}, do: [{snapshot: {}}]}\n"
    assert refused(f"reactions:\n{row}{row}") == (
        "r0.yaml:5:8: a second reaction with id 'a'; expected one (the first is at r0.yaml:4:3)"
    )


@pytest.mark.parametrize(
    ("mine", "theirs", "fight"),
    [
        ("{restart: /x}", "{stop: /x}", True),
        ("{kill: /x}", "{start: /x}", True),
        ("{restart: /x}", "{restart: /x}", False),
        ("{restart: /x}", "{stop: /y}", False),
        ("{lifecycle: {node: /x, transition: activate}}", "{lifecycle: {node: /x, transition: deactivate}}", True),
        ("{set_parameter: {node: /x, name: a, value: 1}}", "{set_parameter: {node: /x, name: a, value: 2}}", True),
        ("{set_parameter: {node: /x, name: a, value: 1}}", "{set_parameter: {node: /x, name: b, value: 2}}", False),
    ],
)
def test_two_documents_that_fight_over_one_node(mine, theirs, fight):
    first = f"reactions: [{{id: a, when: {{node: /x, is: gone}}, do: [{mine}]}}]"
    second = f"kind: reference\nname: site\nreactions: [{{id: b, when: {{node: /y, is: gone}}, do: [{theirs}]}}]"
    if not fight:
        assert len(load(HEAD + first, second).reactions) == 2
        return
    message = refused(first, second)
    assert message.startswith("r1.yaml:3:")
    assert "of node:/x, and `" in message
    assert "at r0.yaml:3:" in message


@pytest.mark.parametrize(
    "when",
    [
        "{any: [{node: /x, is: gone, for: 2 s}, {not: {node: /x, is: gone}}]}",
        "{any: [{node: /x, is: gone}, {not: {node: /y, is: gone}}]}",
        "{any: [{node: /x*, is: gone}, {not: {node: /x*, is: gone}}]}",
        "{all: [{node: /x, is: gone}, {not: {node: /x, is: gone, for: 2 s}}]}",
    ],
)
def test_what_can_be_true_and_false_is_taken(when):
    assert one(when).name == "robot.a"
