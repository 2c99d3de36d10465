"""Plug-ins that come with roslens keep the contract that is asked of others."""

from pathlib import Path

import pytest

from roslens.plugins.contract import check_plugin
from roslens.plugins.discovery import discover
from roslens.plugins.order import order
from roslens.source.plugin_stage import BUILTIN

FIXTURES = Path(__file__).parents[1] / "fixtures" / "plugins"


def members():
    return discover([], base=FIXTURES, builtin=BUILTIN, search=())


def test_all_of_them_load():
    found = members()
    assert not [str(failure) for failure in found.failures]
    assert len(found.members) == len(BUILTIN)


@pytest.mark.parametrize("name", [reference.partition(":")[0].rpartition(".")[2] for reference in BUILTIN])
def test_each_keeps_the_contract(name):
    member = next(member for member in members().members if member.name == name)
    if missing := order([member]).unavailable:
        pytest.skip(f"{missing[0].program} is not installed")
    fixtures = FIXTURES / member.name
    assert check_plugin(member, fixtures if fixtures.is_dir() else None) == ()
