"""Mistakes of each family are planted into real files and found by the command line."""

from pathlib import Path

from planted.measuring import Count, Place, compare, default_rules, measure
from planted.page import page

REAL = Path(__file__).parents[2] / "examples" / "workspace" / "src"
SOME = {
    "cmake.missing_source",
    "cpp.delete_form",
    "cpp.header_function",
    "launch.missing_include",
    "node.queue_size_zero",
    "node.handle_dropped",
    "package.required_tag",
    "python.yaml_load",
}


def test_what_is_planted_into_real_files_is_found():
    rules = [rule for rule in default_rules() if rule.id in SOME]
    counts = measure(rules, [REAL], 7, (0, 3))
    assert counts.keys() == SOME
    assert all(one.found == one.planted and one.planted >= 2 for one in counts.values()), counts


def test_a_finding_elsewhere_in_the_file_counts_for_nothing():
    places = [
        Place("cpp.a", 0, "p/src/a.cpp", 10, 12, 1),
        Place("cpp.a", 1, "p/src/b.cpp", 10, 12),
        Place("cmake.b", 0, "q"),
    ]
    found = [
        {"rule": "cpp.a", "path": "p/src/a.cpp", "line": 9},
        {"rule": "cpp.a", "path": "p/src/b.cpp", "line": 11},
        {"rule": "cpp.b", "path": "p/src/a.cpp", "line": 10},
        {"rule": "cmake.b", "path": "q/CMakeLists.txt", "line": 3},
    ]
    counts = compare(places, found)
    assert counts == {"cmake.b": Count(1, 1), "cpp.a": Count(2, 1, (0,))}
    text = page(counts, ["`a/b`"], 7)
    assert "Of 3 places of 2 rules 2 are found (66.7 %)." in text
    assert "| `cpp.a` | 2 | 1 | 0 |" in text
