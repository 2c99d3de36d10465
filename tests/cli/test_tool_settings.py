"""Settings files of tools count once they are trusted, wherever the configuration is and whatever leads to them."""

import pytest

from roslens.cli.main import main
from roslens.cli.workplace.configuration import Configuration
from roslens.cli.workplace.tool_settings import settings_files, trust_settings, with_settings_files


@pytest.fixture
def workspace(tmp_path):
    """Return a workspace with the settings of a linter, beside the folder of the user's own configuration."""
    (tmp_path / "mine").mkdir()
    (tmp_path / "ws" / "pkg").mkdir(parents=True)
    (tmp_path / "ws" / "CPPLINT.cfg").write_text("exclude_files=.*\n")
    return tmp_path / "ws"


def own(configuration, root, environment, given=False):
    told = []
    found = with_settings_files(configuration, given=given, environment=environment, root=root, tell=told.append)
    return found.source.tools.own_settings, told


def test_a_configuration_elsewhere_does_not_make_settings_of_the_workspace_count(workspace, tmp_path):
    environment = {"XDG_CONFIG_HOME": str(tmp_path / "user")}
    mine = Configuration(base=str(tmp_path / "mine"))
    assert own(mine, workspace, environment)[0] is False
    assert "CPPLINT.cfg" in own(mine, workspace / "pkg", environment)[1][0], "those above count as well"
    assert own(mine, workspace, environment, given=True)[0] is True
    trust_settings(mine, environment, workspace)
    assert own(mine, workspace, environment) == (True, [])
    (workspace / "CPPLINT.cfg").write_text("exclude_files=a\n")
    assert own(mine, workspace, environment)[0] is False


def test_trust_in_a_workspace_is_of_all_folders_in_it(workspace, tmp_path):
    environment = {"XDG_CONFIG_HOME": str(tmp_path / "user")}
    beside = Configuration(base=str(workspace))
    trust_settings(beside, environment, workspace / "pkg")
    assert own(beside, workspace, environment) == own(beside, workspace / "pkg", environment) == (True, [])


def test_settings_behind_links_are_found(workspace, tmp_path):
    for place in (workspace / "node_modules" / "p", tmp_path / "elsewhere" / "deep"):
        place.mkdir(parents=True)
        (place / ".clang-tidy").write_text("Checks: '-*'\n")
    (workspace / "arm").symlink_to("node_modules/p")
    (workspace / "leg").symlink_to(tmp_path / "elsewhere")
    (tmp_path / "elsewhere" / "again").symlink_to(tmp_path / "elsewhere")
    (workspace / "pkg" / "up").symlink_to(tmp_path)
    assert settings_files(str(workspace)) == (
        str(tmp_path / "elsewhere" / "deep" / ".clang-tidy"),
        str(workspace / "CPPLINT.cfg"),
        str(workspace / "node_modules" / "p" / ".clang-tidy"),
    )


def test_the_command_trusts_and_revokes_for_a_configuration_elsewhere(workspace, tmp_path, monkeypatch, capsys):
    monkeypatch.setenv("XDG_CONFIG_HOME", str(tmp_path / "user"))
    (tmp_path / "mine" / "roslens.toml").write_text("")
    words = [str(workspace), "--config", str(tmp_path / "mine" / "roslens.toml")]
    main(["trust", *words])
    assert str(workspace / "CPPLINT.cfg") in capsys.readouterr().out
    main(["trust", *words, "--list"])
    assert "roslens.toml: trusted\n" in capsys.readouterr().out
    main(["trust", *words, "--revoke"])
    main(["trust", *words, "--list"])
    assert "roslens.toml: not trusted\n" in capsys.readouterr().out
