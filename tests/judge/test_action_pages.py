import pytest

from roslens.judge.pages.action_pages import action_page, action_pages
from roslens.judge.reading.read_reference import load_reference
from roslens.live.window.signals import BY_KEY
from roslens.model.acting.action_kind import ACTION_KINDS

HEAD = """\
kind: reference
name: r
reactions:
  - id: one
    when: {node: /driver, is: gone}
    text: "{entity}"
"""


@pytest.mark.parametrize("kind", ACTION_KINDS, ids=lambda one: one.key)
def test_the_example_on_the_page_can_be_read(kind, tmp_path):
    example = action_page(kind).split("```yaml\n")[1].split("```")[0]
    path = tmp_path / "r.yaml"
    path.write_text(HEAD + "".join(f"    {line}\n" for line in example.splitlines()))
    (reaction,) = load_reference([path], BY_KEY).reactions
    assert [step.action.kind for step in reaction.steps] == [kind.key]


def test_every_kind_has_a_page_and_a_row():
    pages = action_pages()
    assert set(pages) == {"actions/README.md", *(f"actions/{one.key}.md" for one in ACTION_KINDS)}
    assert all(f"]({one.key}.md)" in pages["actions/README.md"] for one in ACTION_KINDS)
