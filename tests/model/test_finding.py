from roslens.model.finding import Severity, fingerprint


def test_a_fingerprint_stays_while_lines_move_and_white_space_changes():
    assert fingerprint("r", "file:a.cpp", "if (x)  goto  y;") == fingerprint("r", "file:a.cpp", " if (x) goto y; ")


def test_a_fingerprint_tells_rules_places_contexts_and_repeats_apart():
    prints = {
        fingerprint("r", "file:a.cpp", "x"),
        fingerprint("s", "file:a.cpp", "x"),
        fingerprint("r", "file:b.cpp", "x"),
        fingerprint("r", "file:a.cpp", "y"),
        fingerprint("r", "file:a.cpp", "x", 1),
    }
    assert len(prints) == 5


def test_severities_are_ordered():
    assert [severity.rank for severity in Severity] == [0, 1, 2]
