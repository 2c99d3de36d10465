"""Plug-ins that a workspace names run once the user trusts them, never on completion, and again only as they were."""

import json
import os
import py_compile
from argparse import Namespace
from importlib.util import cache_from_source, find_spec
from pathlib import Path

import pytest

from roslens.cli.main import main
from roslens.cli.terminal.boundary import NOT_ANALYSED
from roslens.cli.workplace import trust as module
from roslens.cli.workplace.configuration import find_configuration
from roslens.cli.workplace.trust import admitted, is_trusted, trust
from roslens.model.errors import UsageError

MANIFEST = '<package format="3"><name>a</name><version>1.0.0</version><description>d</description>\
<maintainer email="a@example.org">a</maintainer><license>MIT</license></package>'

PLUGINS = ["evil.py", "evil_folder", "haros_plugin_evil"]


@pytest.fixture
def workspace(tmp_path, monkeypatch):
    """A clone whose configuration names three plug-ins, each of which says that it ran."""
    root = tmp_path / "clone"
    (root / "a").mkdir(parents=True)
    (root / "a" / "package.xml").write_text(MANIFEST)
    (root / "a" / "a.py").write_text("x = 1\n")
    trap = f"open({str(tmp_path / 'ran')!r}, 'a').write(__file__)\n"
    (root / "evil.py").write_text(trap)
    for name in PLUGINS[1:]:
        (root / name).mkdir()
        (root / name / "__init__.py").write_text(trap)
    (root / "haros_plugin_evil" / "plugin.yaml").write_text("name: haros_plugin_evil\nversion: '1'\n")
    (root / "haros_plugin_evil" / "plugin.py").write_text(trap)
    (root / "roslens.toml").write_text(f"plugins = {json.dumps(['./' + name for name in PLUGINS])}\n")
    monkeypatch.setenv("XDG_CONFIG_HOME", str(tmp_path / "user"))
    # The sandbox would hide what runs: it could leave no file.
    monkeypatch.setenv("ROSLENS_PLUGIN_SANDBOX", "off")
    return root


def ran(root):
    return (root.parent / "ran").exists()


@pytest.mark.parametrize(
    "words", [["check", "--jobs", "1", "-q"], ["plugins"], ["doctor"], ["report", "--no-store", "-q", "--no-graph"]]
)
def test_nothing_of_a_strangers_workspace_runs(workspace, words, capsys, monkeypatch):
    monkeypatch.chdir(workspace.parent)
    code = main([*words, str(workspace)])
    assert not ran(workspace)
    assert code == NOT_ANALYSED or words[0] == "report"
    if words[0] in ("plugins", "doctor"):
        said = capsys.readouterr()
        for name in PLUGINS:
            assert f"plug-in './{name}' was not run: it is not trusted" in said.out + said.err
        assert "roslens trust" in said.out + said.err


def test_the_rest_of_a_check_goes_on_and_the_report_names_what_did_not_run(workspace, tmp_path):
    out = tmp_path / "report.json"
    assert main(["check", str(workspace), "-q", "--jobs", "1", "--format", "json", "-o", str(out)]) == NOT_ANALYSED
    document = json.loads(out.read_text())
    assert "a" in [package["name"] for package in document["packages"]]
    assert sum("not trusted" in failure["what"] for failure in document["failures"]) == len(PLUGINS)


def test_explaining_a_metric_and_completing_run_nothing(workspace, monkeypatch, capsys):
    monkeypatch.chdir(workspace)
    assert main(["explain", "loc"]) == 0
    assert main(["completion", "ids"]) == 0
    assert not ran(workspace)
    main(["trust"])
    assert main(["completion", "ids", "--path", str(workspace)]) == 0
    assert not ran(workspace), "on TAB nothing runs, trusted or not"


@pytest.mark.skipif(find_spec("pygls") is None, reason="pygls is not installed: pip install 'roslens[lsp]'")
def test_an_editor_that_opens_the_folder_runs_nothing(workspace):
    from roslens.cli.editor.language_server import Folder

    options = Namespace(config=None, model=None, no_cache=True)
    folder = Folder(workspace, options)
    folder.end()
    assert not ran(workspace)
    main(["trust", str(workspace)])
    folder = Folder(workspace, options)
    folder.end()
    assert ran(workspace)


def test_configuration_of_a_parent_folder_is_a_strangers_too(workspace):
    main(["check", str(workspace / "a"), "-q", "--jobs", "1"])
    assert not ran(workspace)


def test_one_run_with_trust(workspace):
    main(["check", str(workspace), "-q", "--jobs", "1", "--trust"])
    assert ran(workspace)
    assert not is_trusted(find_configuration(workspace, None), os.environ)


def test_trust_lasts_until_something_changes(workspace, capsys):
    assert main(["trust", str(workspace)]) == 0
    main(["plugins", str(workspace)])
    assert ran(workspace)
    (workspace.parent / "ran").unlink()
    with (workspace / "evil_folder" / "__init__.py").open("a") as stream:
        stream.write("# more\n")
    main(["plugins", str(workspace)])
    assert not ran(workspace)


def test_trust_is_of_one_folder(workspace, tmp_path):
    main(["trust", str(workspace)])
    workspace.rename(tmp_path / "elsewhere")
    assert not is_trusted(find_configuration(tmp_path / "elsewhere", None), os.environ)


def test_listing_and_revoking(workspace, capsys):
    main(["trust", "--list", str(workspace)])
    assert ": not trusted\n" in capsys.readouterr().out
    main(["trust", str(workspace)])
    main(["trust", "--list", str(workspace)])
    assert ": trusted\n" in capsys.readouterr().out
    main(["trust", "--revoke", str(workspace)])
    main(["trust", "--revoke", str(workspace)])
    assert capsys.readouterr().out.splitlines()[-1].endswith("was not trusted")
    assert not is_trusted(find_configuration(workspace, None), os.environ)


@pytest.mark.parametrize("answer", [True, False])
def test_a_terminal_is_asked(workspace, answer):
    configuration = find_configuration(workspace, None)
    questions = []
    found = admitted(
        configuration, given=False, environment=os.environ, ask=lambda text: questions.append(text) or answer
    )
    assert (found == configuration) is answer
    assert len(questions) == 1
    assert "./evil.py" in questions[0]
    assert is_trusted(configuration, os.environ) is answer


def test_what_the_user_trusts_is_private_and_damage_is_told(workspace):
    configuration = find_configuration(workspace, None)
    trust(configuration, os.environ)
    path = Path(os.environ["XDG_CONFIG_HOME"], "roslens", module._FILE)
    assert path.stat().st_mode & 0o777 == 0o600
    path.write_text("{")
    with pytest.raises(UsageError, match="Remove it, then trust again"):
        is_trusted(configuration, os.environ)


def manifest_of(name):
    return (
        "from roslens.plugins.points import Manifest\n"
        f"manifest = Manifest(name={name!r}, interface='1.0', version='1', text='t', scopes=('package',))\n"
        "def analyse_package(package, report):\n    pass\n"
    )


def compiled_beside(source, text):
    """Put byte code of another text where Python looks for that of a source, marked so that it is not checked."""
    other = source.parent.parent / "other.py"
    other.write_text(text)
    cached = Path(cache_from_source(str(source)))
    cached.parent.mkdir(exist_ok=True)
    py_compile.compile(str(other), cfile=str(cached), invalidation_mode=py_compile.PycInvalidationMode.UNCHECKED_HASH)
    other.unlink()


@pytest.mark.parametrize(
    "words", [["plugins"], ["check", "-q", "--jobs", "1"], ["check", "-q", "--jobs", "1", "--trust"]]
)
@pytest.mark.parametrize("kind", ["file", "folder", "haros"])
def test_byte_code_beside_what_is_trusted_never_runs(workspace, words, kind, capsys):
    trap = f"open({str(workspace.parent / 'ran')!r}, 'a').write(__file__)\n"
    folder = workspace / "checks"
    folder.mkdir()
    name = {"file": "checks/goto.py", "folder": "checks/", "haros": "haros_plugin_own"}[kind]
    if kind == "haros":
        folder = workspace / "haros_plugin_own"
        folder.mkdir()
        (folder / "plugin.yaml").write_text("name: haros_plugin_own\nversion: '1'\n")
        (folder / "__init__.py").write_text("")
        (folder / "plugin.py").write_text("def package_analysis(iface, scope):\n    pass\n")
        sources = [folder / "__init__.py", folder / "plugin.py"]
    elif kind == "folder":
        (folder / "__init__.py").write_text("from . import part\n" + manifest_of("own"))
        (folder / "part.py").write_text("x = 1\n")
        sources = [folder / "__init__.py", folder / "part.py"]
    else:
        (folder / "goto.py").write_text(manifest_of("own"))
        sources = [folder / "goto.py"]
    (workspace / "roslens.toml").write_text(f"plugins = ['{name}']\n")
    main(["trust", str(workspace)])
    for source in sources:
        compiled_beside(source, trap)
    main([*words, str(workspace)])
    assert not ran(workspace)
    reported = capsys.readouterr()
    assert "not trusted" not in reported.out + reported.err
    assert "own" in reported.out or words[0] == "check"


def test_a_module_outside_the_plug_in_is_not_imported(workspace, capsys):
    trap = f"open({str(workspace.parent / 'ran')!r}, 'a').write(__file__)\n"
    (workspace / "checks").mkdir()
    (workspace / "shared.py").write_text(trap)
    (workspace / "checks" / "json.py").write_text("mine = True\n")
    begin = "import os, sys\nhere = os.path.dirname(__file__)\nsys.path[:0] = [here, os.path.dirname(here)]\n"
    (workspace / "checks" / "__init__.py").write_text(begin + "import shared\n" + manifest_of("own"))
    (workspace / "roslens.toml").write_text("plugins = ['checks']\n")
    main(["trust", str(workspace)])
    capsys.readouterr()
    main(["plugins", str(workspace)])
    assert not ran(workspace)
    reported = capsys.readouterr()
    assert "shared.py is not part of a trusted plug-in" in reported.out + reported.err
    # What lies in its folder is part of it.
    (workspace / "checks" / "helping.py").write_text("x = 1\n")
    (workspace / "checks" / "__init__.py").write_text(begin + "import helping\n" + manifest_of("own"))
    main(["trust", str(workspace)])
    capsys.readouterr()
    main(["plugins", str(workspace)])
    assert "own 1" in capsys.readouterr().out
