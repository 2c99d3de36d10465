"""What shapes the result of every package of a run besides its files: settings, models and plug-ins."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import msgspec

from roslens.source.chosen_models import model_key
from roslens.source.keys import analyser_version, key_of
from roslens.source.settings import ProcessSettings, SourceSettings

if TYPE_CHECKING:
    from roslens.model.quantity import Quantity
    from roslens.plugins.discovery import Discovered
    from roslens.plugins.member import Member
    from roslens.plugins.points import Manifest


def manifests_of(settings: SourceSettings, plugins: Discovered) -> dict[str, Manifest]:
    """Return the manifests of all that options may be for."""
    from roslens.source.tools.table import tool_named
    from roslens.source.tools.used import TOOLS

    tools = {name: tool_named(name).manifest for name in TOOLS if name in settings.options}
    return {**tools, **{member.name: member.manifest for member in plugins.members}}


def shaping_key(settings: SourceSettings, base: Path, plugins: Discovered) -> str:
    """Return a key of everything besides files that shapes a package's result."""
    models = [model_key(name, base, known_quantities(plugins)) for name in settings.models]
    members = [
        (member.name, member.manifest.version, member.fingerprint, _programs(member)) for member in plugins.members
    ]
    # Where packages were looked for is not part of what one of them is like; plug-ins count by what they are.
    own = msgspec.structs.replace(settings, plugins=(), untrusted=(), process=ProcessSettings())
    return key_of(analyser_version(), own, models, members)


def _programs(member: Member) -> list[tuple[str, int, int]]:
    """Return the programs a plug-in needs, with what changes when one is installed, upgraded or removed."""
    from shutil import which

    found = []
    for need in member.manifest.needs:
        kind, _, name = need.partition(":")
        if kind == "program" and (path := which(name)):
            stat = Path(path).stat()
            found.append((path, stat.st_size, stat.st_mtime_ns))
    return found


def known_quantities(plugins: Discovered) -> dict[str, Quantity]:
    """Return every quantity that a model may name."""
    from roslens.source.history.judged_process import BOUNDABLE
    from roslens.source.metrics.table import QUANTITIES

    offered = (quantity for member in plugins.members for quantity in member.manifest.quantities)
    return {**QUANTITIES, **BOUNDABLE, **{quantity.key: quantity for quantity in offered}}
