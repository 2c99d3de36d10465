"""Plug-ins of nodes that a launch file starts: their parameters say which, and what these make is at the node."""

import pytest

from roslens.model.graph import Role
from roslens.source.extract.configuration.assemble import assemble
from roslens.source.extract.configuration.assemble_plugins import MOST_TURNS
from roslens.source.extract.facts.launched import Launch, Launched, Setting
from roslens.source.extract.facts.node_facts import EndpointFact, Evidence, NodeFacts, PluginFact, Target, TargetKind
from roslens.source.extract.symbolic.reason import EachOf, OfParameter
from roslens.source.extract.symbolic.text import Hole, Text

START, HERE, LOAD = Evidence("pkg/a.launch", 3), Evidence("pkg/src/a.cpp", 5), Evidence("pkg/src/a.cpp", 9)
TARGETS = (Target(TargetKind.EXECUTABLE, "pkg", "prog", (HERE.path,), HERE),)
LIST = Hole(EachOf(OfParameter("plugins")), "plugins", among="[a]")
EACH = Text((Hole(OfParameter("{each of parameter plugins}.plugin"), "*.plugin", named=(Text((LIST, ".plugin")),)),))
UNKNOWN = "its endpoints are unknown"


class Units:
    """Answers with plug-ins by what is chosen, and remembers what it was asked."""

    def __init__(self, again):
        self.asked, self.again = [], again

    def has(self, package):
        return package == "pkg"

    def targets(self, package):
        return TARGETS

    def program(self, path, function="", words=None, chosen=None):
        self.asked.append(None if chosen is None else chosen.values)
        return self.again(chosen)

    def plugins(self):
        return frozenset()

    def parts(self, name):
        return ()

    def scripts(self, package, name):
        return ()

    def built_for(self, package, name):
        return ()

    def checksum(self, interface, generation, path):
        return ""


def facts(*types, made="", endpoints=()):
    plugins = tuple(PluginFact(one, LOAD, "core::Base", made) for one in types)
    return (NodeFacts("Host", HERE.path, 1, "ros2", name=Text.of("host"), plugins=plugins, endpoints=endpoints),)


def said():
    return (EndpointFact(Role.PUBLISHER, Text.of("said"), Text.of("std_msgs/msg/String"), HERE),)


def configured(units, **values):
    settings = tuple(Setting(Text.of(name), Text.of(value), START) for name, value in values.items())
    started = Launched(Text.of("pkg"), Text.of("prog"), START, settings=settings)
    return assemble(Launch("ros2", (started,)), units, title="t")


def endpoints(found):
    return [(one.endpoint.name, one.proof.sure) for one in found.nodes[0].endpoints if not one.implicit]


def known(chosen):
    if chosen is None:
        return facts(EACH)
    return facts(Text.of("p::Talks"), made="p.Talks", endpoints=said())


def test_what_is_set_is_given_to_the_code():
    units = Units(known)
    found = configured(units, **{"plugins": "[x, y]", "x.plugin": "p::Talks"})
    assert units.asked == [None, (("", "plugins", "[x, y]"), ("", "x.plugin", "p::Talks"), ("", "y.plugin", None))]
    assert endpoints(found) == [("/said", "certain")]
    assert found.unresolved == ()


def test_a_default_of_a_list_is_asked_for_its_items():
    units = Units(known)
    configured(units)
    assert units.asked[1] == (("", "plugins", None), ("", "a.plugin", None))


def test_what_defaults_load_is_no_surer_than_they_are():
    usual = Text((Hole("default of parameter type", default="p::Talks"),))
    found = configured(
        Units(lambda chosen: facts(EACH) if chosen is None else facts(usual, made="p.Talks", endpoints=said()))
    )
    assert endpoints(found) == [("/said", "likely")]


def test_a_plugin_may_load_others():
    inner = Text((Hole(OfParameter("x.inner"), "x.inner"),))

    def again(chosen):
        names = () if chosen is None else tuple(one[1] for one in chosen.values)
        if "x.inner" in names:
            return facts(Text.of("q::Q"), made="q.Q", endpoints=said())
        return facts(inner) if names else facts(EACH)

    units = Units(again)
    found = configured(units, **{"plugins": "[x]", "x.plugin": "p::P", "x.inner": "q::Q"})
    assert len(units.asked) == 3
    assert endpoints(found) == [("/said", "certain")]


def test_it_ends_although_each_turn_asks_anew():
    def again(chosen):
        number = 0 if chosen is None else len(chosen.values)
        return facts(Text((Hole(OfParameter(f"p{number}"), f"p{number}"),)))

    units = Units(again)
    found = configured(units)
    assert len(units.asked) == MOST_TURNS + 1
    assert [one.reason for one in found.unresolved] == [
        f"a plug-in of core::Base is loaded, and which one depends on parameter p{MOST_TURNS}: {UNKNOWN}"
    ]


@pytest.mark.parametrize(
    ("kind", "reason"),
    [
        (Text.of("far::Away"), "far::Away, which is not in the workspace"),
        (Text((Hole("result of ask()"),)), "and which one depends on result of ask()"),
    ],
)
def test_what_cannot_be_loaded_is_said(kind, reason):
    found = configured(Units(lambda chosen: facts(kind)))
    whole = f"a plug-in of core::Base is loaded, {reason}: its endpoints are unknown"
    assert [(one.reason, one.node) for one in found.unresolved] == [(whole, "/host")]


def test_a_name_that_is_written_is_followed_at_once():
    units = Units(lambda chosen: facts(Text.of("p::Talks")) if chosen is None else known(chosen))
    assert endpoints(configured(units)) == [("/said", "certain")]
    assert units.asked == [None, ()]


def test_without_plugins_nothing_is_evaluated_twice():
    units = Units(lambda chosen: facts())
    configured(units)
    assert units.asked == [None]


def test_words_of_a_text_are_asked_for():
    words = Text((Hole(OfParameter("sources"), "sources", default=""),))

    def again(chosen):
        (node,) = facts()
        return (NodeFacts("Host", HERE.path, 1, "ros2", name=node.name, asks=() if chosen else (words,)),)

    units = Units(again)
    configured(units, sources="a b")
    assert units.asked == [None, (("", "sources", "a b"),)]
