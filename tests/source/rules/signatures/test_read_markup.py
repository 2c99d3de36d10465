"""The tables of elements of launch files in XML and YAML."""

from roslens.source.rules.signatures.read_markup import part_of, read_markup


def test_a_node_has_what_an_executable_has_but_its_command():
    node = read_markup().elements["node"]
    assert {"pkg", "exec", "output", "launch-prefix", "on_exit"} <= {*node.attributes}
    assert "cmd" not in node.attributes
    assert node.required == ("exec",)
    assert {*node.children} == {"env", "param", "remap"}


def test_what_may_stand_in_an_element_is_known_by_its_name_there():
    elements = read_markup().elements
    assert part_of(elements["include"], "arg").attributes == ("name", "value")
    assert part_of(elements["group"], "node") is elements["node"]
    assert part_of(elements["node"], "group") is None
    assert part_of(elements["load_composable_node"], "composable_node").required == ("pkg", "plugin", "name")


def test_every_row_is_consistent():
    markup = read_markup()
    for one in (*markup.elements.values(), *markup.parts.values()):
        assert {*one.required} <= {*one.attributes}, one.name
        assert {*one.children} - {"*"} <= markup.parts.keys(), one.name
    assert all(least <= most for least, most in markup.substitutions.values())
