from roslens.source.extract.ir.program import Function, Literal, Name, Opaque, Operation
from roslens.source.extract.lowering.cpp.cpp_lowered import DEEPEST, Lowered, name_of, opaque
from roslens.source.syntax.query.cpp_query import parse_tree


def test_a_name_is_qualified_by_the_scope_around() -> None:
    lowered = Lowered(b"")
    assert lowered.qualified("x") == "x"
    lowered.scope = "a.B"
    assert lowered.qualified("x") == "a.B.x"


def test_functions_stand_in_the_order_they_begin() -> None:
    lowered = Lowered(b"")
    outer = lowered.begin_function()
    inner = lowered.begin_function()
    lowered.end_function(inner, Function("lambda", "f.lambda", 2))
    lowered.end_function(outer, Function("f", "f", 1))
    assert [one.name for one in lowered.program().functions] == ["f", "lambda"]


def test_a_macro_that_is_defined_differently_is_a_choice() -> None:
    lowered = Lowered(b"")
    lowered.define_macro("A", Literal("x"))
    lowered.define_macro("A", Literal("x"))
    assert lowered.macros["A"] == Literal("x")
    lowered.define_macro("A", Literal("y"))
    assert lowered.macros["A"] == Operation("?:", (Opaque("#if"), Literal("x"), Literal("y")))
    lowered.define_macro("A", Literal("z"))
    lowered.define_macro("A", Literal("q"))
    assert lowered.macros["A"] == Opaque("one of several definitions")


def test_what_is_too_deep_is_noted() -> None:
    lowered = Lowered(b"\nint x;")
    node = parse_tree(lowered.source).root_node.named_children[0]
    assert lowered.text(node) == b"int x;"
    assert not lowered.too_deep(node)
    lowered.depth = DEEPEST
    assert lowered.too_deep(node)
    assert lowered.program().incomplete == ((2, f"nested deeper than {DEEPEST}"),)


def test_opaque_text_is_short_and_on_one_line() -> None:
    assert opaque(b"a\n  + b") == Opaque("a + b")
    assert len(opaque(b"a" * 1000).text) == 80
    assert name_of("this") == Name("self")
