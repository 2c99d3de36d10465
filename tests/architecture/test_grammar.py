"""Files that no check of the project's own Python reads are written for the oldest Python that runs them.

`ruff` and `mypy` know the oldest Python of roslens itself, but leave out the examples, and what nodes load runs in the
Python of the nodes.
"""

import ast
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
INSIDE = ROOT / "src" / "roslens" / "live" / "inside"


def relative_imports(path: Path) -> set[str]:
    nodes = ast.walk(ast.parse(path.read_text()))
    return {node.module for node in nodes if isinstance(node, ast.ImportFrom) and node.level == 1 and node.module}


def loaded_in_nodes() -> list[Path]:
    found, waiting = {"__init__"}, {"hooks"}
    while waiting:
        found.add(name := waiting.pop())
        waiting |= relative_imports(INSIDE / f"{name}.py") - found
    return [*(INSIDE / f"{name}.py" for name in sorted(found)), INSIDE / "path" / "sitecustomize.py"]


def test_what_nodes_load_is_found():
    assert {"rclpy_hook.py", "ros1_statistics.py", "slots.py"} <= {path.name for path in loaded_in_nodes()}


@pytest.mark.parametrize("path", loaded_in_nodes(), ids=lambda path: path.stem)
def test_nodes_load_it_with_python_3_8_and_without_roslens(path):
    tree = ast.parse(path.read_text(), feature_version=(3, 8))
    imported = [node.module or "" for node in ast.walk(tree) if isinstance(node, ast.ImportFrom) and not node.level]
    imported += [alias.name for node in ast.walk(tree) if isinstance(node, ast.Import) for alias in node.names]
    assert not {"roslens", "msgspec", "numpy"} & {name.partition(".")[0] for name in imported}


def test_examples_that_are_run_are_of_the_oldest_python():
    folders = (ROOT / "examples" / "robot", ROOT / "examples" / "plugin")
    paths = [path for folder in folders for path in folder.rglob("*.py") if "fixtures" not in path.parts]
    assert paths
    for path in paths:
        ast.parse(path.read_text(), str(path), feature_version=(3, 10))


def test_newer_grammar_is_seen():
    text = "match 1:\n    case 1:\n        pass\n"
    ast.parse(text, feature_version=(3, 10))
    with pytest.raises(SyntaxError):
        ast.parse(text, feature_version=(3, 9))
