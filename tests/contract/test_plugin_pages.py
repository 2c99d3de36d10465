"""The pages for writers of plug-ins name everything that the contract has."""

from pathlib import Path

import pytest

from roslens.plugins.contract import look_at
from roslens.plugins.haros.interface import Interface
from roslens.plugins.haros.plugin import FIRST_PASS, SECOND_PASS
from roslens.plugins.options import TYPES
from roslens.plugins.points import HOOKS, Manifest, Report

PAGES = Path(__file__).parents[2] / "docs" / "reference"
CONTRACT = [
    *Manifest.__struct_fields__,
    *HOOKS,
    *HOOKS.values(),
    *TYPES,
    *(name for name in vars(Report) if not name.startswith("_")),
]
HAROS = [
    *(hook for hook in (*FIRST_PASS, *SECOND_PASS) if not hook.startswith("process_configuration")),
    *(
        name
        for name, member in vars(Interface).items()
        if callable(member) and not name.startswith("_") and name not in ("flush", "keep_exports")
    ),
]


@pytest.mark.parametrize(
    ("page", "names"), [("plugins.md", CONTRACT), ("haros_plugins.md", HAROS)], ids=["plugins", "haros"]
)
def test_a_page_names_everything(page, names):
    text = (PAGES / page).read_text()
    assert [name for name in names if f"`{name}" not in text] == []


def test_the_first_plugin_of_the_page_works(tmp_path):
    code = (PAGES / "plugins.md").read_text().split("```python\n")[1].partition("```")[0]
    (tmp_path / "goto.py").write_text(code)
    (tmp_path / "jump.cpp").write_text("int main() {\n  goto end;\nend:\n  return 0;\n}\n")
    outcome = look_at(tmp_path / "goto.py", tmp_path / "jump.cpp")
    assert [(finding.rule, finding.line) for finding in outcome.findings] == [("goto.used", 2)]
    assert not outcome.failures
