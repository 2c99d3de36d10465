from roslens.source.extract.ir.program import NO_EXCEPTION, Name, Opaque, Operation
from roslens.source.extract.symbolic.text import And, NoException, Not, Or, Written
from roslens.source.extract.symbols.lookups import Lookups


def test_the_text_of_an_expression_is_made_once():
    lookups, expression = Lookups(), Operation("not", (Name("ready_"),))
    first = lookups.text(expression)
    assert first == "(not ready_)"
    assert lookups.text(expression) is first


def test_equal_expressions_are_told_apart_by_identity_and_have_equal_texts():
    lookups = Lookups()
    texts = {lookups.text(Operation("not", (Name(name),))) for name in ("a", "b", "a")}
    assert texts == {"(not a)", "(not b)"}


def test_a_condition_is_written_as_people_do():
    lookups = Lookups()
    assert lookups.condition(Operation("not", (Name("ready_"),))) == Not(Written("ready_"))
    assert lookups.condition(Opaque("x < 3")) == Written("x < 3")
    assert str(lookups.condition(Operation("<", (Name("x"), Name("y"))))) == "x < y"
    both = Operation("or", (Operation("and", (Name("a"), Name("b"))), Name("c")))
    assert lookups.condition(both) == Or((And((Written("a"), Written("b"))), Written("c")))
    assert lookups.condition(NO_EXCEPTION) == NoException()
