"""Exit code 3 of ``roslens check``: only where something of what is judged was not analysed."""

import pytest

from roslens.cli.main import main

MANIFEST = """<package format="3"><name>p</name><version>1.0.0</version><description>d</description>
<maintainer email="{}">m</maintainer><license>MIT</license></package>"""
BROKEN = "int f() { return 1; }\nint @ g(;\n"


@pytest.fixture
def check(tmp_path):
    def run(path, *more, email="m@example.org"):
        file = tmp_path / "p" / path
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(BROKEN)
        (tmp_path / "p" / "src").mkdir(exist_ok=True)
        (tmp_path / "p" / "src" / "own.cpp").touch()
        (tmp_path / "p" / "package.xml").write_text(MANIFEST.format(email))
        words = ["check", str(tmp_path), "-q", "--jobs", "1", "--fail-on", "never", "--no-store", "--no-cache", *more]
        return main(words)

    return run


@pytest.mark.parametrize(
    ("path", "code"),
    [
        ("src/a.cpp", 3),
        ("test/a.cpp", 0),
        ("third_party/a.cpp", 0),
        ("lib/date-3.0.4/a.cpp", 0),
        ("src/generated/a.cpp", 0),
    ],
)
def test_a_place_counts_where_it_is_judged(check, capsys, path, code):
    assert check(path) == code
    assert "cannot parse" in capsys.readouterr().out


def test_a_place_that_is_accepted(check):
    assert check("src/a.cpp", "--accept-partial") == 0


def test_a_manifest_that_should_say_otherwise_leaves_nothing_out(check, capsys):
    assert check("test/a.cpp", email="nobody") == 0
    assert "e-mail" in capsys.readouterr().out
