"""Names of macros that a configuration gives: matched as whole words, in time that grows with the length of a file."""

import time

import pytest

from roslens.cli.workplace.configuration import find_configuration
from roslens.model.errors import DocumentError
from roslens.source.settings import MacroSettings
from roslens.source.syntax.macro.macros import load_macros
from roslens.source.syntax.macro.own_macros import OwnMacros


def test_whole_words_of_the_first_kind_that_fits():
    macros = OwnMacros({"anywhere": ("MY_[A-Z]+",), "statement": ("MY_X", "OTHER")})
    assert macros.find(b"MY_X MY_XY1 xMY_X OTHER;") == [(0, 4, "anywhere"), (18, 23, "statement")]


@pytest.mark.parametrize("expression", ["([A-Z_]+)+X", "(?:A|A|AA)+B", "(A*)*(A*)*_"])
def test_what_makes_other_engines_search_for_ever(expression):
    macros = load_macros(MacroSettings(blank=(expression,)))
    content = b"A" * 150 + b" " + b"A_" * 100_000
    begun = time.process_time()
    assert macros.blank(content) == content
    assert time.process_time() - begun < 2


def test_an_expression_that_cannot_be_matched_in_one_pass_is_told_once_and_with_its_place(tmp_path):
    (tmp_path / "roslens.toml").write_text('[macros]\nblank = ["(?=A)B"]\n')
    with pytest.raises(DocumentError, match=r"look-ahead.*one pass") as reported:
        find_configuration(tmp_path, None)
    assert "roslens.toml:2" in reported.value.where
