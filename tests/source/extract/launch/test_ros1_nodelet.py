import msgspec
import pytest

from roslens.model.configuration import ConfiguredNode, Proof
from roslens.source.extract.facts.launched import Launched
from roslens.source.extract.facts.node_facts import Evidence
from roslens.source.extract.launch.ros1_nodelet import Bond, as_nodelet, has_bond, is_process, with_bonds
from roslens.source.extract.symbolic.text import Text, unknown


def started(program, *words):
    package, executable = program.split("/")
    return Launched(Text.of(package), Text.of(executable), Evidence("a", 1), arguments=tuple(map(Text.of, words)))


@pytest.mark.parametrize(
    ("node", "kind", "plugin", "container"),
    [
        (started("nodelet/nodelet", "manager"), "container", "", ""),
        (started("nodelet/nodelet", "load", "a/B", "m", "--no-bond"), "nodelet", "a/B", "m"),
        (started("nodelet/nodelet", "standalone", "a/B"), "nodelet", "a/B", ""),
        (started("nodelet/nodelet", "load", "_a:=1", "a/B", "m"), "nodelet", "a/B", "m"),
        (started("nodelet/nodelet", "load", "a/B"), "node", "", ""),
        (started("nodelet/nodelet"), "node", "", ""),
        (started("other/nodelet", "load", "a/B", "m"), "node", "", ""),
    ],
)
def test_what_is_loaded(node, kind, plugin, container):
    found = as_nodelet(node)
    assert (found.kind, str(found.plugin), str(found.container)) == (kind, plugin, container)


@pytest.mark.parametrize(
    ("words", "bond"),
    [
        (("load", "a/B", "m"), True),
        (("load", "a/B", "m", ""), True),
        (("load", "a/B", "m", "_rate:=1"), True),
        (("load", "a/B", "m", "--no-bond"), False),
        (("load", "a/B", "m", unknown("argument bond")), False),
        (("standalone", "a/B"), False),
        (("manager",), False),
    ],
)
def test_what_has_a_bond(words, bond):
    one = started("nodelet/nodelet")
    texts = tuple(word if isinstance(word, Text) else Text.of(word) for word in words)
    assert has_bond(as_nodelet(msgspec.structs.replace(one, arguments=texts))) is bond


def test_only_the_program_is_a_process():
    assert is_process(started("nodelet/nodelet"))
    assert not is_process(started("a/b"))


def configured(name, kind):
    return ConfiguredNode(name, Proof("a"), kind=kind)


def test_both_ends_of_a_bond_tell_and_listen():
    nodes = [configured("/m", "container"), configured("/a", "nodelet"), configured("/b", "nodelet")]
    manager, one, other = with_bonds(nodes, [Bond("/a", "/m", ("on",))])
    expected = [("publisher", "/m/bond"), ("subscription", "/m/bond")]
    for node, conditions in ((manager, ("on",)), (one, ())):
        assert [(end.endpoint.role.value, end.endpoint.name) for end in node.endpoints] == expected
        assert {(end.endpoint.node, end.endpoint.type) for end in node.endpoints} == {(node.name, "bond/Status")}
        assert {(end.conditions, end.implicit) for end in node.endpoints} == {(conditions, True)}
    assert other.endpoints == ()


def test_the_bond_of_a_manager_is_there_where_one_of_several_needs_no_condition():
    bonds = [Bond("/a", "/m", ("on",)), Bond("/b", "/m")]
    (manager,) = with_bonds([configured("/m", "container")], bonds)
    assert [end.conditions for end in manager.endpoints] == [(), ()]
