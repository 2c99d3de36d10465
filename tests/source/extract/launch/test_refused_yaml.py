"""Launch files in YAML that launch_yaml does not take, by what its parser and its entities ask for."""

import pytest

from roslens.source.extract.launch.refused_yaml import refused_yaml

NODE = "node: {pkg: base, exec: drive}"
REFUSED = {
    "no YAML": ("launch:\n- node: {pkg: base\n", 3, "no YAML"),
    "tab": ("launch:\n- node:\n\tpkg: base\n", 3, "a tab in the indentation"),
    "nothing": ("# to be written\n", 1, "nothing"),
    "no launch": (f"- {NODE}\n", 1, "a list"),
    "other key": (f"lanuch:\n- {NODE}\n", 1, "'lanuch' as the outermost key"),
    "two keys": (f"launch:\n- {NODE}\nparameters: 1\n", 3, "'parameters' beside 'launch'"),
    "table": (f"launch:\n  {NODE}\n", 2, "a table of actions"),
    "text": ("launch: all\n", 1, "'all'"),
    "action of two keys": ("launch:\n- node:\n  pkg: base\n", 2, "an action with 2 keys ('node', 'pkg')"),
    "action that is a text": ("launch:\n- node\n", 2, "'node' as an action"),
    "action in a group": ("launch:\n- group:\n  - node:\n    pkg: base\n", 3, "an action with 2 keys"),
    "encoding": ("launch:\n- log: {message: \xff}\n", 2, "the byte 0xff, which is not UTF-8"),
}


@pytest.mark.parametrize(("text", "line", "what"), REFUSED.values(), ids=REFUSED)
def test_what_is_refused(text, line, what):
    found = refused_yaml(text.encode("latin-1"))
    assert (found.line, found.what.startswith(what)) == (line, True), found


@pytest.mark.parametrize(
    "text",
    [
        f"launch:\n- {NODE}\n",
        f"launch:\n- group:\n  - {NODE}\n- arg: {{name: a}}\n",
        f"launch:\n  children:\n  - {NODE}\n",
        "launch: []\n",
        f"launch:\n- group:\n    scoped: false\n    children:\n    - {NODE}\n",
        "launch:\n- let: {name: !!str a, value: *nothing}\n".replace("*nothing", "b"),
    ],
    ids=range(6),
)
def test_what_is_taken(text):
    assert refused_yaml(text.encode()) is None


def test_deep_and_long_files():
    deep = "launch:\n" + "".join(f"{'  ' * level}- group:\n" for level in range(600))
    assert refused_yaml(deep.encode()).what == "more than 1,000 levels"
    assert refused_yaml(b"launch:\n" + b"- log: {message: a}\n" * 60_000) is None
    assert refused_yaml(b"[" * 100_000) is not None
