import time
from pathlib import Path

import pytest
from pace import slowness

from roslens.cli.commands.init import TEMPLATE
from roslens.cli.workplace.configuration import MOST_BYTES, Configuration, find_configuration, read_configuration
from roslens.model.errors import DocumentError, UsageError
from roslens.source.settings import SourceSettings


def written(folder: Path, text: str, name: str = "roslens.toml") -> Path:
    path = folder / name
    path.write_text(text, "utf-8")
    return path


def test_the_template_says_what_the_defaults_are(tmp_path: Path):
    read = read_configuration(written(tmp_path, TEMPLATE))
    assert read.source == SourceSettings()
    assert (read.fail_on, read.jobs, read.accept_partial) == ("error", 0, False)


def test_every_setting_is_in_the_template(tmp_path: Path):
    import msgspec

    for field in msgspec.structs.fields(SourceSettings):
        if isinstance(field.type, type) and issubclass(field.type, msgspec.Struct):
            for inner in msgspec.structs.fields(field.type):
                if inner.name in ("untrusted", "not_used", "own_settings", "commands"):
                    continue
                assert f"{inner.name} =" in TEMPLATE or f"[{field.name}.{inner.name}]" in TEMPLATE, inner.name
            assert field.name != "tools" or "[tools.semgrep]" in TEMPLATE  # commands, by the name of the tool
        elif field.name not in ("options", "untrusted", "not_used", "own_settings"):  # who is not trusted is no setting
            assert f"\n{field.name} =" in TEMPLATE, field.name


@pytest.mark.parametrize(
    ("text", "place", "says"),
    [
        ('modells = ["ros"]', ":1:1", "Did you mean 'models'"),
        ("[counting]\nlambdas = true\nlamdas = false\n", ":3:1", "Did you mean 'lambdas'"),
        ("[workspace]\nignore = 3\n", ":2:1", "array"),
        ('models = ["ros"\njobs = 1', ":2:", "TOML"),
        ('fail_on = "fatal"', ":1:1", "one of note, warning, error, never"),
        ("counting = 3", ":1:1", "a table [counting]"),
        ("options = 3", ":1:1", "[options.<plug-in>]"),
        ('gate_roles = ["mine"]', ":1:1", "mine"),
        ("[counting]\nduplicate_lines = 'x'\n", ":2:1", "int"),
        ('[graph.configurations.a]\nlaunch = "b"\nargument = {}\n', ":3:1", "Did you mean 'arguments'"),
        ("[graph.configurations.a]\narguments = {}\n", ":1:1", "`launch`"),
        ('[graph.configurations.a]\nlaunch = "b"\narguments = { c = [1] }\n', ":1:1", "int"),
        ('[graph.hints."/a"]\npublish = []\n', ":2:1", "Did you mean 'publishes'"),
    ],
)
def test_errors_say_where_what_and_what_instead(tmp_path: Path, text: str, place: str, says: str):
    path = written(tmp_path, text)
    with pytest.raises(DocumentError) as caught:
        read_configuration(path)
    assert str(caught.value).startswith(f"{path}{place}")
    assert says in str(caught.value)


def test_no_utf8_is_told(tmp_path: Path):
    path = tmp_path / "roslens.toml"
    path.write_bytes(b"models = ['\xff']")
    with pytest.raises(DocumentError, match="byte 11 is not UTF-8"):
        read_configuration(path)


def test_the_nearest_file_counts_and_the_search_ends_at_the_repository(tmp_path: Path):
    repository = tmp_path / "repo"
    deep = repository / "a" / "b"
    deep.mkdir(parents=True)
    (repository / ".git").mkdir()
    written(tmp_path, "jobs = 7")
    assert find_configuration(deep, None) == Configuration(base=str(deep))
    written(repository, "jobs = 3")
    assert find_configuration(deep, None).jobs == 3
    written(repository / "a", "[tool.roslens]\njobs = 2\n", "pyproject.toml")
    assert find_configuration(deep, None).jobs == 2


def test_a_pyproject_error_names_its_line(tmp_path: Path):
    path = written(tmp_path, "[tool.other]\nx = 1\n\n[tool.roslens.macros]\nblanck = []\n", "pyproject.toml")
    with pytest.raises(DocumentError, match=r"pyproject.toml:5:1: unknown key 'macros.blanck'"):
        read_configuration(path)


def test_a_given_file_must_exist(tmp_path: Path):
    with pytest.raises(UsageError, match="roslens init"):
        find_configuration(tmp_path, "nowhere.toml")


def test_brackets_without_end_are_told(tmp_path: Path):
    path = tmp_path / "roslens.toml"
    path.write_text("models = " + "[" * 5000)
    with pytest.raises(DocumentError, match="brackets are nested too deep"):
        read_configuration(path)


def test_a_file_that_is_larger_than_a_configuration_is_told(tmp_path):
    path = tmp_path / "roslens.toml"
    path.write_text("#" * (MOST_BYTES + 1))
    with pytest.raises(DocumentError, match=r"roslens\.toml: a file of 1,000,001 bytes; at most 1,000,000 are read"):
        read_configuration(path)
    path.write_text("#" * MOST_BYTES)
    assert read_configuration(path).fail_on == "error"


def test_a_large_pyproject_that_configures_something_is_not_passed_over(tmp_path):
    path = tmp_path / "pyproject.toml"
    path.write_text("#" * MOST_BYTES + '\n[tool.roslens]\nfail_on = "note"\n')
    with pytest.raises(DocumentError, match=r"pyproject\.toml: .* at most 1,000,000 are read"):
        find_configuration(tmp_path, None)
    path.write_text("#" * MOST_BYTES + "\n[tool.other]\n")
    assert find_configuration(tmp_path, None).path == ""


def test_blanks_behind_a_bracket_in_a_text_cost_nothing(tmp_path):
    path = tmp_path / "roslens.toml"
    path.write_text('engine = """\n[' + " " * 100_000 + '\n"""\n[ rules ]\nnone = 1\n')
    begun = time.process_time()
    with pytest.raises(DocumentError, match=r"roslens\.toml:5:1: unknown key 'rules\.none'"):
        read_configuration(path)
    assert time.process_time() - begun < slowness()


def test_a_number_that_python_does_not_convert_is_an_error_of_the_file(tmp_path):
    path = tmp_path / "roslens.toml"
    path.write_text("jobs = " + "9" * 5000 + "\n")
    with pytest.raises(DocumentError, match="4300 digits"):
        read_configuration(path)


@pytest.mark.parametrize(
    ("text", "place"),
    [("a = = 1\n", ":1:5"), ("a = [", ":1:6"), ('[models]\na = "b\n', ":2:7"), ("a = [1,\n 2\n\n", ":2:3")],
)
def test_what_is_no_toml_is_told_with_its_line_also_where_it_is_not_closed(tmp_path, text, place):
    (tmp_path / "roslens.toml").write_text(text)
    with pytest.raises(DocumentError, match=f"roslens.toml{place}: "):
        find_configuration(tmp_path, None)
