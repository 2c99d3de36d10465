from __future__ import annotations

from roslens.model.source import Language, SourceFile
from roslens.source.metrics.size import files


def test_it_is_their_number():
    assert files.of_files([SourceFile("a.cpp", Language.CPP), SourceFile("b.py", Language.PYTHON)]) == 2
    assert files.of_files([]) == 0
