from roslens.source.extract.ir.program import (
    Assign,
    Branch,
    Call,
    Class,
    Evaluate,
    Field,
    Format,
    Function,
    Item,
    Lambda,
    Literal,
    Loop,
    Mapping,
    Member,
    Name,
    Opaque,
    Operation,
    Parameter,
    Program,
    Return,
    Sequence,
)
from roslens.source.extract.ir.program_text import expression_text, program_text

PUB = Call(Member(Name("self"), "create"), (Literal("x"), Literal(1)), (("latch", Literal(True)),), ("a::B", "C"), 7, 3)


def test_a_program_as_text() -> None:
    program = Program(
        language="cpp",
        includes=(("<a.hpp>", 1),),
        using=("std",),
        imports={"fs": "boost::filesystem"},
        macros={"TOPIC": Literal("scan")},
        classes=(Class("T", "n.T", 4, ("r.Node",), (Field("a_", "int", Literal(3), 5), Field("b_", "B")), ("X",)),),
        functions=(
            Function(
                "T",
                "n.T.T",
                6,
                "n.T",
                (Parameter("name", "const std::string &", Literal("x")), Parameter("n")),
                initialisers=(Assign(Member(Name("self"), "a_"), Name("n")),),
                body=(
                    Assign(Name("x"), None, "int", line=8),
                    Evaluate(PUB, 7),
                    Branch(Name("c"), (Return(None),), (Return(Lambda(1)),)),
                    Loop(Name("i"), Name("all"), (Evaluate(Call(Name("f"))),)),
                    Loop(None, Name("c"), ()),
                    Loop(None, None, (Assign(Name("s"), Literal("a"), operator="+="),)),
                ),
                decorators=(Name("d"),),
            ),
            Function("lambda", "n.T.T.lambda", 9),
        ),
        body=(Assign(Name("n.X"), Literal(None), "A *", line=20),),
        incomplete=((12, "}"),),
        declarations=(Function("f", "n.f", 3, parameters=(Parameter("r", "double", Literal(1.5)),)),),
    )
    assert program_text(program) == (
        "include <a.hpp>\n"
        "using std\n"
        "import fs = boost::filesystem\n"
        'macro TOPIC = "scan"\n'
        "class n.T<X>(r.Node)\n"
        "  a_: int = 3\n"
        "  b_: B\n"
        "@d\n"
        'function n.T.T(name: const std::string & = "x", n) of n.T\n'
        "  init self->a_ = n\n"
        "  x: int\n"
        '  self->create<a::B, C>("x", 1, latch=true)\n'
        "  if c:\n"
        "    return\n"
        "  else:\n"
        "    return lambda#1\n"
        "  for i in all:\n"
        "    f()\n"
        "  while c:\n"
        "  loop:\n"
        '    s += "a"\n'
        "function#1 n.T.T.lambda()\n"
        "declared n.f(r: double = 1.5)\n"
        "body\n"
        "  n.X: A * = null\n"
        "incomplete 12: }\n"
    )
    assert '  self->create<a::B, C>("x", 1, latch=true)@7:3 @7\n' in program_text(program, lines=True)


def test_expressions_as_text() -> None:
    a, b = Name("a"), Literal("ü\n")
    assert expression_text(Item(a, b)) == 'a["ü\\n"]'
    assert expression_text(Operation("?:", (a, b, Literal(1.5)))) == '(a ? "ü\\n" : 1.5)'
    assert expression_text(Operation("not", (a,))) == "(not a)"
    assert expression_text(Operation("+", (a, a, a))) == "(a + a + a)"
    assert expression_text(Sequence((a, b))) == '[a, "ü\\n"]'
    assert expression_text(Format((a, b))) == 'format[a, "ü\\n"]'
    assert expression_text(Mapping(((b, a),))) == '{"ü\\n": a}'
    assert expression_text(Opaque("x * y")) == "`x * y`"
