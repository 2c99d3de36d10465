"""The quantities of the 2016 study."""

from __future__ import annotations

from roslens.model.entity import EntityKind
from roslens.source.tools.cccc_quantities import CCCC_QUANTITIES


def test_every_quantity_is_of_the_study_and_explains_itself():
    for quantity in CCCC_QUANTITIES:
        assert quantity.key.startswith("paper2016.")
        assert all((quantity.title, quantity.unit, quantity.text, quantity.formula, quantity.source, quantity.limits))


def test_nothing_folds_because_the_study_has_its_own_means():
    for quantity in CCCC_QUANTITIES:
        assert quantity.folds == ()
        assert EntityKind.PACKAGE in quantity.kinds


def test_what_the_study_compares_is_there():
    keys = {quantity.key.removeprefix("paper2016.") for quantity in CCCC_QUANTITIES}
    assert keys >= {"loc", "comment_lines", "comment_ratio", "cyclomatic_complexity", "cbo", "wmc", "mac", "noc", "dit"}
    assert len(keys) == len(CCCC_QUANTITIES)
