import pytest

PUB = "create_publisher<std_msgs::msg::String>({}, 1);"
LOOP = "for (int i = 0; i < number(); ++i) {{ {} }}"


@pytest.mark.parametrize(
    ("turn", "methods"),
    [
        (PUB.format("a_") + "set();", 'void set() { a_ = "b"; }'),
        (PUB.format("a_") + "this->set();", 'void set() { a_ = "b"; }'),
        ("make(); set();", f'void set() {{ a_ = "b"; }}\nvoid make() {{ {PUB.format("a_")} }}'),
        ("both();", f'void both() {{ {PUB.format("a_")} a_ = "b"; }}'),
        ("if (ask()) { set(); }\n" + PUB.format("a_"), 'void set() { a_ = "b"; }'),
    ],
)
def test_what_a_turn_reads_before_a_method_sets_it_is_not_what_it_was(node_of, turn: str, methods: str):
    (one,) = node_of(LOOP.format(turn), f'{methods}\nstd::string a_ = "a";').endpoints
    assert one.name.known is None


@pytest.mark.parametrize(
    ("turn", "methods", "name"),
    [
        ("set();\n" + PUB.format("a_"), 'void set() { a_ = "b"; }', "b"),
        (PUB.format("a_") + "look();", "void look() { use(a_); }", "a"),
        ("both();", f'void both() {{ a_ = "b"; {PUB.format("a_")} }}', "b"),
        ("if (ask()) { set(); } else { set(); }\n" + PUB.format("a_"), 'void set() { a_ = "b"; }', "b"),
    ],
)
def test_what_each_turn_sets_before_it_reads_it_is_known(node_of, turn: str, methods: str, name: str):
    (one,) = node_of(LOOP.format(turn), f'{methods}\nstd::string a_ = "a";').endpoints
    assert one.name.known == name


def test_numbers_too(node_of):
    turn = PUB.format("std::to_string(n_)") + "next();"
    (one,) = node_of(LOOP.format(turn), "void next() { ++n_; }\nint n_ = 1;").endpoints
    assert one.name.known is None
