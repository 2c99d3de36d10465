"""Plug-ins are found before they are imported, and what is wrong with one stops no other."""

import pickle
import shutil

import msgspec
import pytest

from roslens.plugins.discovery import discover
from roslens.plugins.member import Member

pytestmark = pytest.mark.timed

WOULD_NOT_LOAD = {
    "raises_at_import": "RuntimeError: not today",
    "exits_at_import": "it called sys.exit('leaving')",
    "dies_at_import": "while it was imported, its process ended with exit code 7",
    "hangs_at_import": "while it was imported, it took longer than 1 s",
    "misses_module": "ModuleNotFoundError: No module named 'a_module_that_nobody_has'",
}
BREAKS_CONTRACT = {
    "without_manifest": "it has no `manifest`",
    "wrong_types": "its manifest does not fit: Expected `array`, got `str`",
    "breaches": "it is written for interface 2.0",
}


def test_each_failure_is_named_and_the_good_ones_load(fixtures):
    paths = [f"{name}.py" for name in (*WOULD_NOT_LOAD, *BREAKS_CONTRACT, "nowhere", "orderly")]
    found = discover(paths, base=fixtures, search=(), time_limit_s=1.0)
    assert [member.name for member in found.members] == ["orderly"]
    expected = [
        *(f"plug-in {name!r} would not load: {what}" for name, what in WOULD_NOT_LOAD.items()),
        *(f"plug-in {name!r} breaks the contract: {what}" for name, what in BREAKS_CONTRACT.items()),
        "plug-in 'nowhere.py' would not load: there is no such file",
    ]
    assert len(found.failures) == len(expected)
    for text in expected:
        assert any(str(failure).startswith(text) for failure in found.failures), text


def test_all_breaches_of_a_manifest_are_told(fixtures):
    (failure,) = discover(["breaches.py"], base=fixtures, search=()).failures
    for part in (
        "written for interface 2.0",
        "declares scope 'package' and has no analyse_package",
        "has analyse_file and does not declare scope 'file'",
        "language 'pyton' is unknown",
        "rule 'other.rule' is not the plug-in's own",
    ):
        assert part in str(failure)


def test_members_say_where_they_come_from(fixtures):
    found = discover(["orderly.py", "folder_plugin", "object_plugin.py"], base=fixtures, search=())
    assert [(member.name, member.origin, member.hooks) for member in found.members] == [
        ("folder_plugin", "file folder_plugin", ("analyse_workspace",)),
        ("object_plugin", "file object_plugin.py", ("analyse_file",)),
        ("orderly", "file orderly.py", ("analyse_file", "analyse_package")),
    ]
    again = msgspec.msgpack.decode(msgspec.msgpack.encode(found.members), type=tuple[Member, ...])
    assert again == found.members
    assert pickle.loads(pickle.dumps(found.members)) == found.members


def test_loading_leaves_nothing_in_the_folder(tmp_path, fixtures):
    shutil.copytree(fixtures / "folder_plugin", tmp_path / "mine", ignore=shutil.ignore_patterns("__pycache__"))
    assert discover(["mine"], base=tmp_path, search=()).members
    assert sorted(path.name for path in (tmp_path / "mine").iterdir()) == ["__init__.py", "words.py"]


def test_the_fingerprint_follows_the_files(tmp_path, fixtures):
    copy = tmp_path / "mine.py"
    copy.write_text((fixtures / "orderly.py").read_text())
    first = discover(["mine.py"], base=tmp_path, search=()).members[0].fingerprint
    assert first == discover(["mine.py"], base=tmp_path, search=()).members[0].fingerprint
    copy.write_text(copy.read_text() + "\n")
    assert first != discover(["mine.py"], base=tmp_path, search=()).members[0].fingerprint


def installed(folder, name, entry_points, modules):
    info = folder / f"{name}-1.5.dist-info"
    info.mkdir(parents=True)
    (info / "METADATA").write_text(f"Metadata-Version: 2.1\nName: {name}\nVersion: 1.5\n")
    (info / "entry_points.txt").write_text(entry_points)
    for module, text in modules.items():
        (folder / module).write_text(text)


def test_entry_points_are_found_without_import(tmp_path, fixtures, monkeypatch):
    text = (fixtures / "orderly.py").read_text()
    entry_points = (
        "[console_scripts]\nx = y:z\n\n[roslens.plugins]\norderly = installed_orderly\n"
        "broken = installed_broken:plugin\n# a remark\nabsent = installed_orderly:absent [extra]\n"
    )
    modules = {"installed_orderly.py": text, "installed_broken.py": "import os; os._exit(5)\n"}
    installed(tmp_path, "acme_checks", entry_points, modules)
    monkeypatch.syspath_prepend(str(tmp_path))
    found = discover([], base=fixtures, search=[str(tmp_path), str(tmp_path / "nowhere")])
    assert [(member.name, member.origin) for member in found.members] == [
        ("orderly", "entry point orderly of acme-checks 1.5")
    ]
    assert [failure.what.partition(";")[0] for failure in found.failures] == [
        "plug-in 'absent' would not load: no 'absent' in module 'installed_orderly'",
        "plug-in 'broken' would not load: while it was imported, its process ended with exit code 5",
    ]
    assert found.members[0].fingerprint


@pytest.mark.parametrize("name", ["broken", "orderly"])
def test_what_is_disabled_is_not_imported(name, tmp_path, fixtures, monkeypatch):
    trace = tmp_path / "imported"
    entry_points = f"[roslens.plugins]\n{name} = installed_trace\n"
    installed(tmp_path, "acme", entry_points, {"installed_trace.py": f"open({str(trace)!r}, 'w').close()\n"})
    monkeypatch.syspath_prepend(str(tmp_path))
    # In its sandbox it could leave no trace.
    monkeypatch.setenv("ROSLENS_PLUGIN_SANDBOX", "off")
    found = discover([], disable=[name], base=fixtures, search=[str(tmp_path)])
    assert (found.members, found.failures) == ((), ())
    assert not trace.exists()
    discover([], base=fixtures, search=[str(tmp_path)])
    assert trace.exists()


def test_a_misspelt_name_to_disable_is_told(fixtures):
    found = discover(["orderly.py"], disable=["orderley", "something_else"], base=fixtures, search=())
    (failure,) = found.failures
    assert "'orderley' in `disable` is not an installed plug-in" in str(failure)
    assert "Did you mean 'orderly'?" in str(failure)


def test_of_two_plugins_of_one_name_the_first_is_used(tmp_path, fixtures):
    copy = tmp_path / "copy.py"
    copy.write_text((fixtures / "orderly.py").read_text())
    found = discover(["orderly.py", str(copy)], base=fixtures, search=())
    assert [member.origin for member in found.members] == ["file orderly.py"]
    assert "two plug-ins are called 'orderly'" in str(found.failures[0])


def test_nothing_that_merely_lies_in_the_workspace_runs(tmp_path, monkeypatch):
    folder = tmp_path / "haros_plugin_trap"
    folder.mkdir()
    (folder / "plugin.yaml").write_text("name: haros_plugin_trap\nversion: 1\n")
    (folder / "plugin.py").write_text("raise SystemExit\n")
    monkeypatch.syspath_prepend(str(tmp_path))
    assert not [failure for failure in discover([], base=tmp_path).failures if "trap" in str(failure)]


def test_folders_that_are_no_plugins_get_advice(tmp_path):
    (tmp_path / "project").mkdir()
    (tmp_path / "project" / "pyproject.toml").touch()
    (failure,) = discover(["project"], base=tmp_path, search=()).failures
    assert "it is not a plug-in" in str(failure)
    assert "Install it" in str(failure)


def test_built_in_plugins_need_no_worker_and_no_prefix(monkeypatch, fixtures):
    monkeypatch.syspath_prepend(str(fixtures))
    monkeypatch.setattr("subprocess.Popen", None)
    found = discover([], base=fixtures, builtin=["orderly", "no_such_module"], search=())
    assert [(member.name, member.builtin) for member in found.members] == [("orderly", True)]
    assert "this is a fault of roslens" in str(found.failures[0])


def test_what_needs_something_that_is_not_there_is_left_out(fixtures):
    found = discover(["wide.py", "needy.py"], base=fixtures, search=())
    assert [member.name for member in found.members] == ["wide"], "a quantity may be measured elsewhere"
    (failure,) = found.failures
    assert str(failure).startswith("plug-in 'needy' needs the program 'a-program-that-nobody-has', which is not")
    found = discover(["wide.py"], base=fixtures, search=(), provided={"loc"})
    assert "plug-in 'wide' needs quantity 'orderly.words', which nothing measures" in str(found.failures[0])


def test_a_built_in_plugin_without_its_program_is_unavailable(fixtures, monkeypatch):
    monkeypatch.syspath_prepend(str(fixtures))
    found = discover([], base=fixtures, builtin=["needy"], search=())
    assert [member.name for member in found.members] == ["needy"]
    assert [(item.plugin, item.program) for item in found.unavailable] == [("needy", "a-program-that-nobody-has")]
    assert not found.failures
