import pytest


@pytest.mark.parametrize(
    ("read", "type_"),
    [
        ('get_parameter("x").as_double()', "double"),
        ('get_parameter("x").as_string_array()', "string_array"),
        ('get_parameter("x").as_integer_array()', "int_array"),
        ('get_parameter("x").get_value<std::vector<bool>>()', "bool_array"),
        ('get_parameter("x").get_parameter_value().get<std::string>()', "string"),
        ('get_parameter("x").get_value<T>()', ""),
        ('get_parameter("x").get_value()', ""),
    ],
)
def test_what_a_value_is_taken_for_is_its_type(node_of, read, type_):
    (one,) = node_of(f"auto v = {read};").parameters
    assert (one.access, one.type) == ("read", type_)


def test_what_is_declared_stays_and_names_are_followed(node_of):
    facts = node_of(
        'declare_parameter("x", 1); auto v = get_parameter("x").as_int();'
        'pub_ = create_publisher<std_msgs::msg::String>(get_parameter("t").as_string(), 1);'
    )
    assert [(one.access, str(one.name), one.type) for one in facts.parameters] == [
        ("declared", "x", "int"),
        ("read", "x", "int"),
        ("read", "t", "string"),
    ]
    assert [str(one.name) for one in facts.endpoints] == ["{parameter t}"]
