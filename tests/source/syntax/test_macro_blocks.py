"""Tests whose names are texts, as Catch2 and doctest write them."""

import pytest

from roslens.source.syntax.cpp import parse_cpp
from roslens.source.syntax.macro.macro_blocks import name_blocks
from roslens.source.syntax.macro.macros import load_macros

MACROS = load_macros()


@pytest.mark.parametrize(
    ("source", "name"),
    [
        ('TEST_CASE("it works", "[tag]") { f(); }', "TEST_CASE(_it_works_,__tag__)"),
        ('TEST_CASE("alone")\n{\n  f();\n}', "TEST_CASE(_alone_)"),
        ('TEST_CASE_METHOD(Fixture, "a, b") { f(); }', "TEST_CASE_METHOD(Fixture,_a__b_)"),
        ('SCENARIO("sized", "[v]") { f(); }', "SCENARIO(_sized_,__v__)"),
        ('TEMPLATE_TEST_CASE("n", "", int, A<B, C>) { f(); }', "TEMPLATE_TEST_CASE(_n_,__,int,A_B__C_)"),
        ("BOOST_DATA_TEST_CASE(a, data::make(1)) { f(); }", "BOOST_DATA_TEST_CASE(a,data__make_1_)"),
    ],
)  # fmt: skip
def test_a_test_is_a_function_named_like_it(source, name):
    facts = parse_cpp(source.encode(), MACROS)
    assert facts.faults == ()
    (function,) = facts.functions
    assert (function.name, function.counts["call"]) == (name, 1)


def test_sections_are_blocks_of_their_test():
    source = """
TEST_CASE("sizes", "[v]") {
  SECTION("small") { if (a) { REQUIRE(b); } }
  GIVEN("one") { WHEN("two") { THEN("three") { CHECK(c()); } } }
  DYNAMIC_SECTION("x" << 1) { go(); }
  BENCHMARK("y") { return go(); };
}
int after() { return 1; }
"""
    facts = parse_cpp(source.encode(), MACROS)
    assert facts.faults == ()
    assert [one.name for one in facts.functions] == ["TEST_CASE(_sizes_,__v__)", "after"]
    assert facts.functions[0].counts["if"] == 1


@pytest.mark.parametrize(
    "source", ['if (CHECK("a")) { f(); }', 'x = MAKE("a") { };', 'LOG("a");\n{ f(); }', '// TEST_CASE("a") {']
)
def test_what_is_no_block_stays(source):
    assert name_blocks(source.encode()) == source.encode()
