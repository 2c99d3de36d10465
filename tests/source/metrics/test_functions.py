from __future__ import annotations

from roslens.source.metrics.size import functions
from roslens.source.settings import CountingSettings
from roslens.source.syntax.facts import FileFacts, Lines


def test_it_is_their_number(function_of):
    facts = FileFacts("cpp", Lines(), functions=(function_of(), function_of()))
    assert functions.of_file(facts, CountingSettings()) == 2
