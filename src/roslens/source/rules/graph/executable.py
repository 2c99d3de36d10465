"""Rule ``graph.executable``: a launch file starts what no build makes."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import PurePath

from roslens.model.configuration import NAME_IS_GUESSED, Configuration, ConfiguredNode
from roslens.model.finding import Finding
from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.graph.doubt import weighed
from roslens.source.rules.graph.ends import is_launched, listed
from roslens.source.rules.graph.likeness import likely_program, nearest_name
from roslens.source.rules.graph.occurrence import graph_rule, occurrence
from roslens.source.rules.graph.surroundings import Surroundings

RULE = graph_rule(
    "graph.executable",
    "Node that is not installed",
    "A launch file starts an executable, or loads a component or nodelet, that its package does not install. Only "
    "packages of the workspace whose build could be evaluated completely are checked, and names of packages that are "
    "nearly that of one which has the executable. Correct the name, or install it.",
    Consequence.STOPS_START,
    Certainty.PROVEN,
    ("ros", "graph", "launch", "package"),
    "Launching fails, or continues without the node, on the target machine.",
)

_WHAT = {"component": "component", "nodelet": "nodelet"}
_ENDS = frozenset({".py", ".sh", ".bash", ".pl", ".rb", ".lua", ".exe"})
_FILES = frozenset({"__init__.py", "setup.py", "LICENSE", "README", "Makefile", "Dockerfile", "CHANGELOG"})


def found(configuration: Configuration, surroundings: Surroundings) -> Iterator[Finding]:
    """Yield a finding for each name that is started and not installed."""
    if not is_launched(configuration):
        return
    missing: dict[tuple[str, str], list[ConfiguredNode]] = {}
    for node in configuration.nodes:
        package, name = _owner(node)
        installed = surroundings.installed.get(package)
        # A whole path is started as it is, whatever the package (``os.path.join`` and ``which`` keep it).
        if not name or "*" in package + name or node.kind == "process" or name.startswith("/"):
            continue
        if installed is None:
            if _misspelt(package, name, node, surroundings):
                missing.setdefault((package, name), []).append(node)
            continue
        if not {name, node.executable} & set(installed):
            missing.setdefault((package, name), []).append(node)
    for (package, name), nodes in sorted(missing.items()):
        yield _told(package, name, nodes, surroundings)


def _misspelt(package: str, name: str, node: ConfiguredNode, surroundings: Surroundings) -> str:
    """Return the package of the workspace that was meant: nearly the same name, and it has what is started.

    Empty where the package may be one of those that are installed: who starts it depends on it.
    """
    if any(one.name == package for one in surroundings.packages):
        return ""
    around = [
        one for one in surroundings.packages if node.proof.path.startswith(f"{one.path}/") or one.path in ("", ".")
    ]
    if any(one.name == package for owner in around for one in owner.dependencies):
        return ""
    near = nearest_name(package, sorted(surroundings.installed))
    return near if name in surroundings.installed.get(near, ()) else ""


def _owner(node: ConfiguredNode) -> tuple[str, str]:
    """Return the package and the name in it; a nodelet is loaded as ``package/Class``."""
    if node.kind == "nodelet" and "/" in node.executable:
        package, _, name = node.executable.partition("/")
        return package, name
    return node.package, node.executable


def _told(package: str, name: str, nodes: list[ConfiguredNode], surroundings: Surroundings) -> Finding:
    node = min(nodes, key=lambda one: (len(one.conditions), one.proof))
    near = _misspelt(package, name, node, surroundings)
    more = f"`{package}` may be installed on the target machine" if near else ""
    # The name that a node is given without its code says nothing about what a launch file starts.
    proofs = () if near or node.proof.how == NAME_IS_GUESSED else (node.proof,)
    certainty, doubt = weighed(RULE.certainty, proofs, node.conditions, more=more)
    what = _WHAT.get(node.kind, "executable")
    if near:
        message = (
            f"no package `{package}` is known, of which {node.proof.place} starts {what} `{name}`; "
            f"did you mean `{near}`, which installs it? Else add <exec_depend>{package}</exec_depend>."
        )
    else:
        message = (
            f"no {what} `{name}` in package {package}, which {node.proof.place} starts as {node.name}"
            f"{_unbuilt(name, surroundings.unbuilt.get(package, ())) or _advice(name, package, surroundings.installed)}"
        )
    return occurrence(
        RULE, message, node.proof, entity=f"package:{package}", certainty=certainty, context=name, doubt=doubt
    )


def _unbuilt(name: str, sources: tuple[str, ...]) -> str:
    """Return the end of the message where a source of that name is there, and no target is made of it."""
    source = next((path for path in sources if PurePath(path).stem == name), "")
    return f"; {source} is not built: add it to CMakeLists.txt." if source else ""


def _advice(name: str, package: str, installed: dict[str, tuple[str, ...]]) -> str:
    """Return the end of the message: what was likely meant, who has it, or what there is."""
    programs = [one for one in installed[package] if _is_program(one)]
    if near := likely_program(name, programs):
        return f"; did you mean `{near}`?"
    if having := [other for other, names in sorted(installed.items()) if name in names and _is_program(name)]:
        return f"; package {listed(having)} has one of that name."
    return f". It installs {listed(sorted(programs), 5) or 'nothing'}: correct the name, or install it."


def _is_program(name: str) -> bool:
    """Whether a name may be one of something that is started: files of any kind are found by roslaunch too."""
    end = PurePath(name).suffix
    return ":" not in name.replace("::", "") and (not end or end in _ENDS) and name not in _FILES
