"""Lists of C++ that are filled place by place."""

MEMBERS = "std::vector<std::string> names_;"


def publisher(name):
    return f"create_publisher<std_msgs::msg::String>({name}, 1);"


def test_a_place_gives_what_was_put_there(node_of):
    facts = node_of(f'names_.resize(2); names_[0] = "a"; names_[1] = "b"; {publisher("names_[1]")}', MEMBERS)
    assert [one.name.known for one in facts.endpoints] == ["b"]


def test_another_place_is_unknown(node_of):
    facts = node_of(f'names_[0] = "a"; {publisher("names_[1]")}', MEMBERS)
    assert [one.name.known for one in facts.endpoints] == [None]


def test_what_is_put_there_under_a_condition_is_not_sure(node_of):
    facts = node_of(f'names_[0] = "a"; if (far) {{ names_[0] = "b"; }} {publisher("names_[0]")}', MEMBERS)
    assert [one.name.known for one in facts.endpoints] == [None]


def test_an_item_of_an_unknown_list_stands_for_each(node_of):
    body = (
        'auto all = declare_parameter("all", std::vector<std::string>{});\n'
        f"for (size_t i = 0; i < all.size(); ++i) {{ names_[i] = all[i]; }}\n"
        f"for (size_t i = 0; i < all.size(); ++i) {{ {publisher('names_[i]')} }}"
    )
    (one,) = node_of(body, MEMBERS).endpoints
    assert [hole.parameter for hole in one.name.holes] == ["all"]
