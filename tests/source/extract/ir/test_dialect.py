import pytest

from roslens.source.extract.ir.dialect import CPP, DIALECTS, PYTHON
from roslens.source.extract.ir.program import Program


@pytest.mark.parametrize(("language", "dialect"), [("cpp", CPP), ("python", PYTHON)])
def test_a_program_has_the_rules_of_its_language(language, dialect):
    assert Program(language).dialect is dialect


def test_no_rule_is_the_same_in_all_languages():
    for rule in CPP.__struct_fields__:
        assert len({getattr(one, rule) for one in DIALECTS.values()}) == len(DIALECTS), rule
