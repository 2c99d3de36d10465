"""From a corpus to all results of a study."""

from __future__ import annotations

from roslens.model.study import Corpus, Study
from roslens.source.study import paper_tables
from roslens.source.study.correlate import correlate
from roslens.source.study.describe import describe
from roslens.source.study.measurements import measurements
from roslens.source.study.paper_statements import paper_statements
from roslens.source.study.rule_totals import rule_totals
from roslens.source.study.shapes import shapes_of

_NO_MEASUREMENT = ("role",)


def study_of(corpus: Corpus, by: str = "") -> Study:
    """Return the study of a corpus, grouped by a field of its subjects or not at all.

    Raises:
        UsageError: a library of the extra ``study`` is not installed.
    """
    with measurements(corpus) as connection:
        figures = describe(connection, corpus)
        groups = describe(connection, corpus, by) if by else ()
    rules = rule_totals(corpus.broken)
    correlations = correlate(corpus, _NO_MEASUREMENT)
    of_paper = corpus.kind == paper_tables.KIND
    statements = paper_statements(corpus, rules, correlations) if of_paper else ()
    return Study(corpus, by, figures, groups, shapes_of(corpus, by), rules, correlations, statements)
