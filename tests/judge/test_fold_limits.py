"""Several limits broken by one entity."""

import msgspec

from roslens.judge.quality.fold_limits import fold_limits, limits_broken
from roslens.model.finding import Finding, Severity


def limit(rule, text, value, bound, entity="function:a.cpp#f()", severity=Severity.WARNING, model="ros"):
    return Finding(
        f"{model}.{rule}.max",
        severity,
        f"{text} in f",
        "a.cpp",
        3,
        entity=entity,
        tags=("metrics", rule),
        fingerprint=rule,
        quantity=rule,
        value=value,
        bound=bound,
        model=model,
        breach=text if model else "",
    )


CALLS = limit("calls", "90 calls (limit 10, 9.0 x)", 90, 10, severity=Severity.NOTE)
LINES = limit("eloc", "140 executable lines (limit 70, 2.0 x)", 140, 70)
PATHS = limit("static_paths", "1000 static paths (limit 250, 4.0 x)", 1000, 250)


def test_one_function_that_breaks_three_limits_is_one_finding_with_three_reasons():
    (one,) = fold_limits([CALLS, LINES, PATHS])
    assert one.rule == "ros.function_limits"
    assert one.message == (
        "1000 static paths (limit 250, 4.0 x), 140 executable lines (limit 70, 2.0 x) "
        "and 90 calls (limit 10, 9.0 x) in f"
    )
    assert one.severity is Severity.WARNING
    assert (one.quantity, one.value, one.bound) == ("static_paths", 1000, 250)
    assert one.others == (
        "ros.static_paths.max: 1000 static paths (limit 250, 4.0 x)",
        "ros.eloc.max: 140 executable lines (limit 70, 2.0 x)",
        "ros.calls.max: 90 calls (limit 10, 9.0 x)",
    )
    assert one.tags == ("metrics", "static_paths", "eloc", "calls")
    assert limits_broken(one) == ("ros.static_paths.max", "ros.eloc.max", "ros.calls.max")


def kept(*findings):
    """Return findings as they are kept: what is broken stands in the message alone."""
    return tuple(msgspec.structs.replace(one, breach="") for one in findings)


def test_what_breaks_one_limit_and_what_no_model_makes_stays():
    rule = Finding("cpp.goto", Severity.NOTE, "m", entity="function:a.cpp#f()")
    assert fold_limits([CALLS, rule]) == kept(CALLS, rule)
    assert (limits_broken(CALLS), limits_broken(rule)) == (("ros.calls.max",), ())


def test_models_and_entities_are_apart():
    other = limit("calls", "90 calls (limit 5, 18 x)", 90, 5, model="his")
    elsewhere = limit("eloc", "80 executable lines (limit 70, 1.1 x)", 80, 70, entity="function:a.cpp#g()")
    assert fold_limits([CALLS, other, elsewhere]) == kept(CALLS, other, elsewhere)


def test_the_finding_is_the_same_whichever_limit_is_exceeded_most():
    worse = limit("eloc", "1400 executable lines (limit 70, 20 x)", 1400, 70)
    (one,), (two,) = fold_limits([LINES, PATHS]), fold_limits([worse, PATHS])
    assert one.quantity != two.quantity
    assert one.fingerprint == two.fingerprint


def test_notes_about_an_extreme_function_are_witnesses_of_one_finding():
    def breach(model, quantity, severity, excess):
        return Finding(
            f"{model}.{quantity}.max", severity, f"{quantity} in f", "a.cpp", 1, entity="function:a.cpp#f()",
            quantity=quantity, value=excess, bound=1.0, model=model, breach=quantity,
        )  # fmt: skip

    extreme = breach("extreme", "static_paths", Severity.WARNING, 9.0)
    notes = [breach("ros", "static_paths", Severity.NOTE, 900.0), breach("ros", "calls", Severity.NOTE, 3.0)]
    (one,) = fold_limits([notes[1], extreme, notes[0]])
    assert (one.rule, one.severity) == ("extreme.static_paths.max", Severity.WARNING)
    assert one.witnesses == ("ros.static_paths.max", "ros.calls.max")
    assert limits_broken(one) == ("extreme.static_paths.max", "ros.static_paths.max", "ros.calls.max")
    meant = breach("ros", "eloc", Severity.WARNING, 2.0)
    assert len(fold_limits([extreme, meant])) == 2
