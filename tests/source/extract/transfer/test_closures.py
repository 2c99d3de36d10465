import pytest

from roslens.source.extract.symbolic.condition import as_written

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
    assert [(str(one.name), as_written(one.conditions)) for one in node_of(body).endpoints] == [("a", ("on",))]


def test_parameters_of_a_lambda_are_its_own(node_of):
    body = 'std::string t = "a"; auto own = [](std::string t) { t = "b"; }; own("c");'
    (one,) = node_of(f"{body} {PUB.format('t')}").endpoints
    assert one.name.known == "a"


def test_a_name_that_a_lambda_has_a_copy_of_is_what_it_was(node_of):
    for captures in ("t, this", "=", "=, &u", "t = t, this"):
        body = (
            f'std::string t = "a"; std::string u; auto make = [{captures}]() {{ {PUB.format("t")} }}; t = "b"; make();'
        )
        (one,) = node_of(body).endpoints
        assert one.name.known == "a", captures


def test_a_name_that_a_lambda_refers_to_is_what_it_is_when_it_is_called(node_of):
    for captures in ("&", "&t, this", "=, &t", "&, u"):
        body = (
            f'std::string t = "a"; std::string u; auto make = [{captures}]() {{ {PUB.format("t")} }}; t = "b"; make();'
        )
        (one,) = node_of(body).endpoints
        assert one.name.known == "b", captures


def test_what_a_condition_changes_between_a_lambda_and_its_call_is_a_choice(node_of):
    body = f'std::string t = "a"; auto make = [&]() {{ {PUB.format("t")} }}; if (ask()) {{ t = "b"; }} make();'
    (one,) = node_of(body).endpoints
    assert str(one.name) == "{b if ask(), else a}"


@pytest.mark.parametrize(
    "body",
    [
        'std::string t = "a"; std::string & r = t; auto set = [&]() { r = "b"; }; set();',
        'std::string t = "a"; auto set = [&]() {\nauto inner = [&]() { t = "b"; }; inner(); }; set();',
        'std::string t = "a"; int n = 1; int & r = n; auto set = [&]() { t = "b"; }; set();',
    ],
)
def test_what_a_lambda_sets_under_another_name_or_within_another_one_is_not_what_it_was(node_of, body: str):
    (one,) = node_of(f"{body} {PUB.format('t')}").endpoints
    assert one.name.known is None


def test_a_lambda_that_changes_its_copies_is_not_sure_of_them(node_of):
    body = f'std::string t = "a"; auto make = [t, this]() mutable {{ t += "b"; {PUB.format("t")} }}; make(); make();'
    assert all(one.name.known != "abb" for one in node_of(body).endpoints)
