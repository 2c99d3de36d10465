from __future__ import annotations

from roslens.source.metrics.size import classes
from roslens.source.settings import CountingSettings
from roslens.source.syntax.facts import ClassFacts, FileFacts, Lines


def test_it_is_their_number():
    facts = FileFacts("cpp", Lines(), classes=(ClassFacts("A", "A", "struct", 1, 1, 2),))
    assert classes.of_file(facts, CountingSettings()) == 1
