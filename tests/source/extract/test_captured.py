import pytest

PUB = "pub_ = create_publisher<std_msgs::msg::String>({}, 1);"


@pytest.mark.parametrize(
    "body",
    [
        'std::string t = "a"; auto set = [&]() { t = "b"; }; set();',
        'std::string t = "a"; auto set = [&t](int) { if (ask()) { t = "b"; } }; set(3);',
        'std::string t = "a"; if (ask()) { [&]() { t = "b"; }(); }',
        'std::string t = "a"; auto add = [&](const std::string & more) { t += more; }; add("b");',
    ],
)
def test_what_a_lambda_sets_is_not_what_it_was(node_of, body: str):
    (one,) = node_of(f"{body} {PUB.format('t')}").endpoints
    assert one.name.known is None


def test_what_a_lambda_only_reads_stays(node_of):
    body = 'std::string t = "a"; auto read = [&]() { std::string u = t; return u; }; read();'
    (one,) = node_of(f"{body} {PUB.format('t')}").endpoints
    assert one.name.known == "a"


def test_a_truth_value_that_a_lambda_sets_decides_nothing(node_of):
    body = "bool on = false; auto set = [&on]() { on = true; }; set(); if (on) {" + PUB.format('"a"') + "}"
    assert [(str(one.name), one.conditions) for one in node_of(body).endpoints] == [("a", ("on",))]


def test_parameters_of_a_lambda_are_its_own(node_of):
    body = 'std::string t = "a"; auto own = [](std::string t) { t = "b"; }; own("c");'
    (one,) = node_of(f"{body} {PUB.format('t')}").endpoints
    assert one.name.known == "a"
