"""Nodes written by chance are compiled and run: what they make is held against what evaluation says of them."""

import shutil

import pytest
from compiled_nodes.disagreement import compiled, disagreements, evaluated
from compiled_nodes.programs import program

COMPILER = shutil.which("g++")
PROGRAMS = 24
SEEDS = 20

pytestmark = [pytest.mark.slow, pytest.mark.skipif(COMPILER is None, reason="no g++ on this machine")]


def node(body, members="", before=""):
    return (
        f"namespace p {{\n{before}\nclass Talker : public rclcpp::Node {{ public:\n"
        f'Talker() : rclcpp::Node("p") {{\n{body}\n}}\n{members}\n}};\n}}\n'
    )


PUB = "create_publisher<std_msgs::msg::String>({}, 1);\n"
KNOWN = {
    "what a lambda sets that it captures by reference": node(
        'std::string a = "a";\nauto set = [&]() { a = "b"; };\nset();\n' + PUB.format("a")
    ),
}
"""What evaluation is known to say wrongly, and why."""


@pytest.fixture(scope="module")
def runs(tmp_path_factory):
    programs = [program(seed, f"p{seed}") for seed in range(PROGRAMS)]
    return compiled(programs, tmp_path_factory.mktemp("nodes"), SEEDS, COMPILER)


@pytest.mark.parametrize("seed", range(PROGRAMS))
def test_a_node_written_by_chance(runs, seed):
    assert not disagreements(evaluated(program(seed, f"p{seed}")), runs[seed])


def test_what_is_wrong_is_found(runs, tmp_path):
    text = node(PUB.format('"a"') + "if (ask(1)) {\n" + PUB.format('"b"') + "}")
    (made,) = compiled([text], tmp_path, SEEDS, COMPILER)
    assert not disagreements(evaluated(text), made)
    other = evaluated(text.replace('"a"', '"c"').replace("ask(1)", "true"))
    found = disagreements(other, made)
    assert [one.partition(":")[0] for one in found] == ["missing", "not always", "never", "not always"]


@pytest.mark.parametrize("text", [pytest.param(text, id=why) for why, text in KNOWN.items()])
@pytest.mark.xfail(strict=True, reason="evaluation is known to be wrong here")
def test_what_is_known_to_be_wrong(text, tmp_path):
    (made,) = compiled([text], tmp_path, SEEDS, COMPILER)
    assert not disagreements(evaluated(text), made)
