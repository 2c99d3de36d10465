from roslens.model.errors import RoslensError, UsageError
from roslens.model.failure import Failure
from roslens.model.source import Location


def test_a_failure_says_what_where_expected_and_next():
    failure = Failure("syntax", "cannot parse `}`", "C++", "Mend it", Location("a.cpp", 3, 1))
    assert str(failure) == "a.cpp:3:1: cannot parse `}`; expected C++. Mend it"


def test_an_error_has_the_same_form():
    error = UsageError("no folder 'x'", where="here", expected="a folder", advice="Name another")
    assert isinstance(error, RoslensError)
    assert str(error) == "here: no folder 'x'; expected a folder. Name another"
