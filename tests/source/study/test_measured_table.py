"""Tables of one's own, and what is wrong with them."""

import pytest

from roslens.model.errors import UsageError
from roslens.source.metrics.table import QUANTITIES
from roslens.source.study.csv_rows import read_csv
from roslens.source.study.measured_table import corpus_of_table


def table(tmp_path, text, encoding="utf-8"):
    path = tmp_path / "t.csv"
    path.write_bytes(text.encode(encoding))
    return read_csv(path)


def test_a_table(tmp_path):
    rows = table(tmp_path, 'package,role,loc,taste\na,driver,10,3\n"b, too",,,4.5\n\n')
    corpus = corpus_of_table(rows, list(QUANTITIES.values()))
    assert [(one.name, one.role, one.values) for one in corpus.packages] == [
        ("a", "driver", {"loc": 10, "taste": 3}),
        ("b, too", "", {"taste": 4.5}),
    ]
    assert [(one.title, one.unit) for one in corpus.columns] == [("Lines of code", "lines"), ("taste", "")]
    assert corpus.size_key == "loc"


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "no header"),
        ("package,loc\na,ten\n", ':2: "ten" in the column "loc"'),
        ("package,loc\na,nan\n", ':2: "nan" in the column "loc"'),
        ("package,loc\na,1\nb,1,2\n", ":3: a row of 3 cells; expected 2"),
        ("package,loc,loc\na,1,1\n", 'two columns are called "loc"'),
        ("package,role\na,driver\n", "no column with a quantity"),
        ("package,loc\n,1\n", ":2: a row without a name"),
        ('package,loc\n"a,1\n', "no CSV"),
    ],
)
def test_what_is_wrong_is_told_with_its_place(tmp_path, text, message):
    with pytest.raises(UsageError, match=message):
        corpus_of_table(table(tmp_path, text), ())


def test_other_encodings_and_files_are_refused(tmp_path):
    with pytest.raises(UsageError, match="byte 13 is not UTF-8"):
        table(tmp_path, "package,loc\n\xe4,1\n".replace("\n\xe4", "\nx\xe4"), "latin-1")
    with pytest.raises(UsageError, match="cannot be read"):
        read_csv(tmp_path)
