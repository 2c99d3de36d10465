import pytest

PUB = "create_publisher<std_msgs::msg::String>({}, 1);"


@pytest.mark.parametrize(
    ("body", "handler", "after"),
    [
        ('a = "b"; risk(); a = "c"; risk();', None, None),
        ('a = "b"; if (ask()) { a = "c"; } risk();', None, None),
        ('for (int i = 0; i < number(); ++i) { a = a + "x"; risk(); }', None, None),
        ('a = "b"; risk();', "{b if no exception, else a}", "{b if no exception, else a}"),
        ("risk();", "a", "a"),
    ],
)
def test_what_is_set_more_than_once_is_not_known_in_a_handler_nor_after_it(node_of, body, handler, after):
    tried = f"try {{ {body} }} catch (const std::exception &) {{\n{PUB.format('a')} }}\n{PUB.format('a')}"
    one, other = node_of(f'std::string a = "a"; {tried}').endpoints
    for name, expected in ((one.name, handler), (other.name, after)):
        if expected is None:
            assert name.known is None
            assert "more than once" in str(name)
        else:
            assert str(name) == expected


def test_what_a_handler_sets_itself_is_known(node_of):
    tried = 'try { a = "b"; risk(); a = "c"; risk(); } catch (const std::exception &) { a = "d"; }\n'
    (one,) = node_of(f'std::string a = "a"; {tried}{PUB.format("a")}').endpoints
    assert str(one.name) == "{c if no exception, else d}"
