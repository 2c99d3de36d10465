"""Who imports whom in ``src``, distinguished by when an import is carried out, and the circles in it."""

from __future__ import annotations

import ast
from collections.abc import Iterator, Mapping
from enum import Enum
from pathlib import Path

SOURCE = Path(__file__).parents[2] / "src"


class When(Enum):
    """When an import is carried out."""

    LOADED = "when the module is loaded"
    CALLED = "when a function is called"
    CHECKED = "by type checkers alone"


Graph = dict[str, dict[str, When]]


def modules(root: Path = SOURCE) -> dict[str, Path]:
    """Return the files of the modules below a folder by the name that they are imported under."""
    found = {}
    for path in sorted(root.rglob("*.py")):
        parts = path.relative_to(root).with_suffix("").parts
        found[".".join(parts[:-1] if parts[-1] == "__init__" else parts)] = path
    return found


def imports(root: Path = SOURCE) -> Graph:
    """Return for each module below a folder those of its modules that it imports, and when it first does."""
    files = modules(root)
    graph: Graph = {name: {} for name in files}
    for name, path in files.items():
        package = name if path.stem == "__init__" else name.rpartition(".")[0]
        for node, when in _imports(ast.parse(path.read_text()), When.LOADED):
            for target in _targets(node, package, files):
                if target != name and not name.startswith(f"{target}."):
                    graph[name][target] = min(when, graph[name].get(target, when), key=list(When).index)
    return graph


def circles(graph: Mapping[str, Mapping[str, When]], *times: When) -> list[list[str]]:
    """Return the sets of modules each of which comes back to itself over imports of some times, sorted."""
    edges = {name: [target for target, when in found.items() if when in times] for name, found in graph.items()}
    return sorted(sorted(one) for one in _strongly_connected(edges) if len(one) > 1)


def _imports(tree: ast.AST, when: When) -> Iterator[tuple[ast.Import | ast.ImportFrom, When]]:
    for node in ast.iter_child_nodes(tree):
        if isinstance(node, ast.Import | ast.ImportFrom):
            yield node, when
        elif isinstance(node, ast.If) and "TYPE_CHECKING" in ast.dump(node.test):
            yield from ((one, When.CHECKED) for one, _ in _imports(node, when))
        elif isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef) and when is When.LOADED:
            yield from _imports(node, When.CALLED)
        else:
            yield from _imports(node, when)


def _targets(node: ast.Import | ast.ImportFrom, package: str, files: Mapping[str, Path]) -> Iterator[str]:
    if isinstance(node, ast.Import):
        yield from (alias.name for alias in node.names if alias.name in files)
        return
    above = package.split(".")[: len(package.split(".")) - node.level + 1] if node.level else []
    module = ".".join([*above, *filter(None, [node.module])])
    for alias in node.names:
        inner = f"{module}.{alias.name}"
        if inner in files:
            yield inner
        elif module in files:
            yield module


def _strongly_connected(edges: Mapping[str, list[str]]) -> Iterator[list[str]]:
    """Yield the strongly connected components of a graph, after Tarjan, without recursion."""
    order: dict[str, int] = {}
    low: dict[str, int] = {}
    path: list[str] = []
    for start in edges:
        work = [] if start in order else [(start, iter(edges[start]))]
        while work:
            name, left = work[-1]
            if name not in order:
                order[name] = low[name] = len(order)
                path.append(name)
            for target in left:
                if target not in order:
                    work.append((target, iter(edges[target])))
                    break
                if target in low:
                    low[name] = min(low[name], low[target])
            else:
                work.pop()
                if work and work[-1][0] in low:
                    above = work[-1][0]
                    low[above] = min(low[above], low[name])
                if low[name] == order[name]:
                    place = path.index(name)
                    for one in path[place:]:
                        del low[one]
                    yield path[place:]
                    del path[place:]
