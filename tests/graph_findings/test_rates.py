"""Rates are of code and findings that count."""

import tomllib

from graph_findings.rates import lines_of, rates_text


def report(*findings):
    files = [{"path": "a.cpp", "role": "own"}, {"path": "b.cpp", "role": "vendored"}]
    loc = [{"entity": f"file:{name}", "quantity": "loc", "value": 500.0} for name in ("a.cpp", "b.cpp")]
    return {"files": files, "measurements": loc, "findings": list(findings)}


def finding(rule, tool="roslens", *, gated=True):
    return {"rule": rule, "tool": tool, "gated": gated}


def test_lines_of_others_do_not_count():
    assert lines_of(report()) == 500


def test_findings_are_counted_by_rule_and_repository():
    first = report(finding("cpp.a"), finding("cpp.a"), finding("cpp.b", gated=False), finding("eloc.max", "metrics"))
    table = tomllib.loads(rates_text([first, report(finding("cpp.a"), finding("cpp.c"))]))
    assert table == {"lines": 1000, "repositories": 2, "rules": {"cpp.a": [3, 2], "cpp.c": [1, 1]}}
