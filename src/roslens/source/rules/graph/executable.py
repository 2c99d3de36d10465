"""Rule ``graph.executable``: a launch file starts what no build makes."""

from __future__ import annotations

from collections.abc import Iterator

from roslens.model.configuration import Configuration, ConfiguredNode
from roslens.model.finding import Finding, RuleInfo, Severity
from roslens.source.rules.graph.doubt import weighed
from roslens.source.rules.graph.ends import is_launched, listed
from roslens.source.rules.graph.likeness import nearest_name
from roslens.source.rules.graph.surroundings import Surroundings
from roslens.source.rules.graph.told import TOOL, told

RULE = RuleInfo(
    "graph.executable",
    "Node that is not installed",
    "A launch file starts an executable, or loads a component or nodelet, that its package does not install. Only "
    "packages of the workspace whose build is understood in full are held against it. Correct the name, or install it.",
    Severity.ERROR,
    ("ros", "graph", "launch", "package"),
    "Launching fails, or goes on without the node, on the machine where it matters.",
    tool=TOOL,
    scope="configuration",
)


def found(configuration: Configuration, surroundings: Surroundings) -> Iterator[Finding]:
    """Yield a finding for each name that is started and not installed."""
    if not is_launched(configuration):
        return
    missing: dict[tuple[str, str], list[ConfiguredNode]] = {}
    for node in configuration.nodes:
        package, name = _owner(node)
        installed = surroundings.installed.get(package)
        if installed is None or not name or "*" in package + name or node.kind == "process":
            continue
        if not {name, node.executable} & set(installed):
            missing.setdefault((package, name), []).append(node)
    for (package, name), nodes in sorted(missing.items()):
        yield _told(package, name, nodes, surroundings.installed[package])


def _owner(node: ConfiguredNode) -> tuple[str, str]:
    """Return the package and the name in it; a nodelet is loaded as ``package/Class``."""
    if node.kind == "nodelet" and "/" in node.executable:
        package, _, name = node.executable.partition("/")
        return package, name
    return node.package, node.executable


def _told(package: str, name: str, nodes: list[ConfiguredNode], installed: tuple[str, ...]) -> Finding:
    node = min(nodes, key=lambda one: (len(one.conditions), one.proof))
    severity, doubt = weighed(RULE.severity, (node.proof,), node.conditions)
    near = nearest_name(name, list(installed))
    advice = f"Did you mean `{near}`?" if near else f"It installs {listed(sorted(installed), 5) or 'nothing'}."
    message = (
        f"{node.proof.place} starts `{name}` of {package} as {node.name}, which {package} does not install. "
        f"{advice}{doubt}"
    )
    return told(RULE, message, node.proof, entity=f"package:{package}", severity=severity, context=name)
