"""What a rule found counts by the language of the file."""

from roslens.source.rules.hit import Hit
from roslens.source.rules.place_hits import place_hits
from roslens.source.rules.table import native_rules


def test_c_has_arrays_of_variable_length():
    rules = native_rules()
    hits = {path: [Hit("cpp.variable_length_array", "m", 1)] for path in ("a.c", "a.cpp")}
    selection = {"cpp.variable_length_array": rules["cpp.variable_length_array"].severity}
    assert [one.path for one in place_hits(hits, (), selection, rules, ())] == ["a.cpp"]
