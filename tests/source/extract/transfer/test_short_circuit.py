import pytest

from roslens.source.extract.symbolic.condition import as_written

PUB = "create_publisher<std_msgs::msg::String>({}, 1);"
SET = 'bool set(std::string & s) { s = "b"; return ask(2); }'
SET_MEMBER = 'bool set() { s_ = "b"; return ask(2); }\nstd::string s_ = "a";'


@pytest.mark.parametrize(
    ("condition", "name"),
    [
        ("ask(1) && set(s)", "{b if ask(1), else a}"),
        ("ask(1) || set(s)", "{b if not ask(1), else a}"),
        ("true && set(s)", "b"),
        ("set(s) && ask(1)", "b"),
        ("false && set(s)", "a"),
    ],
)
def test_what_an_operand_sets_that_may_not_be_reached_is_a_choice(node_of, condition: str, name: str):
    body = f'std::string s = "a"; bool on = {condition};\n{PUB.format("s")}'
    (one,) = node_of(body, SET).endpoints
    assert str(one.name) == name


def test_what_it_sets_in_its_object_is_one_too(node_of):
    (one,) = node_of(f"bool on = ask(1) && set();\n{PUB.format('s_')}", SET_MEMBER).endpoints
    assert str(one.name) == "{b if ask(1), else a}"


def test_what_an_operand_makes_has_its_condition(node_of):
    method = f"bool make(std::string s) {{ {PUB.format('s')} return true; }}"
    found = node_of('bool on = ask(1) && make("a");', method).endpoints
    assert [(str(one.name), as_written(one.conditions)) for one in found] == [("a", ("ask(1)",))]
    found = node_of('ask(1) ? make("a") : make("b");', method).endpoints
    assert {str(one.name): as_written(one.conditions) for one in found} == {
        "a": ("ask(1)",),
        "b": ("not ask(1)",),
    }


def test_that_what_came_before_went_well_is_no_condition(node_of):
    methods = "".join(
        f"bool {name}() {{ {PUB.format(chr(34) + name + chr(34))} return ask(1); }}\n" for name in ("one", "two")
    )
    found = node_of("if (!one() || !two()) { return; }", methods).endpoints
    assert {str(one.name): as_written(one.conditions) for one in found} == {"one": (), "two": ()}


def test_what_was_not_known_before_is_what_it_becomes(node_of):
    methods = SET + "\nstd::string s_;"
    (one,) = node_of(f"if (!ask(1) || !set(s_)) {{ return; }}\n{PUB.format('s_')}", methods).endpoints
    assert str(one.name) == "b"
