from roslens.source.extract.ir.program import NO_EXCEPTION, Name, Opaque, Operation
from roslens.source.extract.symbolic.text import And, NoException, Not, Or, Written
from roslens.source.extract.symbols.memo import Memo


def test_the_text_of_an_expression_is_made_once():
    memo, expression = Memo(), Operation("not", (Name("ready_"),))
    first = memo.text(expression)
    assert first == "(not ready_)"
    assert memo.text(expression) is first


def test_equal_expressions_are_told_apart_by_identity_and_have_equal_texts():
    memo = Memo()
    texts = {memo.text(Operation("not", (Name(name),))) for name in ("a", "b", "a")}
    assert texts == {"(not a)", "(not b)"}


def test_a_condition_is_written_as_people_do():
    memo = Memo()
    assert memo.condition(Operation("not", (Name("ready_"),))) == Not(Written("ready_"))
    assert memo.condition(Opaque("x < 3")) == Written("x < 3")
    assert str(memo.condition(Operation("<", (Name("x"), Name("y"))))) == "x < y"
    both = Operation("or", (Operation("and", (Name("a"), Name("b"))), Name("c")))
    assert memo.condition(both) == Or((And((Written("a"), Written("b"))), Written("c")))
    assert memo.condition(NO_EXCEPTION) == NoException()
