from roslens.source.extract.facts.launched import Setting
from roslens.source.extract.facts.node_facts import Evidence
from roslens.source.extract.launch.ros1_doubt import Doubt, only_if, setting_if
from roslens.source.extract.symbolic.text import Text

USUALLY = Doubt("$(optenv A 1)", usual=True)
NOT_USUALLY = Doubt("$(optenv B 0)", usual=False)
NOBODY_KNOWS = Doubt("$(env C)")


def test_what_is_not_in_doubt_stays():
    assert only_if((), Text.of("x"), Text.of("y")) == Text.of("x")
    assert only_if((NOBODY_KNOWS,), Text.of("x"), Text.of("x")) == Text.of("x")


def test_what_stands_there_usually_is_told():
    assert only_if((USUALLY,), Text.of("x"), Text.of("y")).usual == "x"
    assert only_if((NOT_USUALLY,), Text.of("x"), Text.of("y")).usual == "y"
    assert only_if((NOT_USUALLY,), Text.of("x")).usual is None
    assert only_if((USUALLY, NOBODY_KNOWS), Text.of("x")).usual is None
    assert only_if((USUALLY, NOBODY_KNOWS), Text.of("x")).holes[0].reason == "x, if $(optenv A 1) and $(env C)"


def test_parameters_in_doubt_have_no_known_value():
    one = Setting(Text.of("~a"), Text.of("1"), Evidence("a.launch", 1), "int")
    assert setting_if((), one) is one
    assert setting_if((NOBODY_KNOWS,), one).value.known is None
