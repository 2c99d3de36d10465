"""What is found below a folder of what is no longer used is a note."""

import pytest

from roslens.model.weight.consequence import Certainty
from roslens.source.rules.by_package.left_behind import as_notes_where_left_behind
from roslens.source.rules.hit import Hit


@pytest.mark.parametrize(
    ("path", "is_note"),
    [
        ("p/src/OLD/a.cpp", True),
        ("deprecated/tools/a.py", True),
        ("not_for_build/p/a.cpp", True),
        ("p/src/old.cpp", False),
        ("p/src/threshold/a.cpp", False),
        ("p/src/a.cpp", False),
    ],
)
def test_the_name_of_a_folder_says_so(path, is_note):
    (only,) = as_notes_where_left_behind({path: [Hit("cpp.guard", "m", 1)]})[path]
    assert (only.certainty is Certainty.HEURISTIC) is is_note
