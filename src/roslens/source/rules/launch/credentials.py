"""Rule ``launch.credentials``: a password or key in a launch file or a file of parameters."""

from __future__ import annotations

import re
from collections.abc import Iterator

from roslens.model.source import Language, Role
from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.hit import Hit
from roslens.source.rules.package_view import PackageView
from roslens.source.rules.rule import PackageRule

_NAME = re.compile(
    r"(?:^|[_\W])(?:passw(?:or)?d|passphrase|secret|(?:api|access)_?key|(?:auth|access)_?token)$", re.IGNORECASE
)
_YAML = re.compile(r"^\s*-?\s*['\"]?([\w./-]+)['\"]?\s*:\s*['\"]?([^\s'\"#]{4,})['\"]?\s*(?:#.*)?$")
_NOTHING = re.compile(
    r"^(?:\$|\{|<|none|null|true|false|changeme|your|xxx+|\*+|todo|example|test$|~|some[-_]|dummy|placeholder|insert"
    r"|my[-_]?passw)",
    re.IGNORECASE,
)


def found(view: PackageView) -> Iterator[Hit]:
    """Yield each password, key or token with a value; the value is not repeated."""
    for file in view.launch:
        for element, _ in file.elements:
            name = element.attributes.get("name", "")
            value = element.attributes.get("value") or element.attributes.get("default") or ""
            if _is_secret(name, value):
                yield file.hit("launch.credentials", element, _message(name), name)
    for one in view.of_language(Language.YAML, Language.LAUNCH_YAML, roles=(Role.OWN,)):
        text = view.read(one.path)
        if b"passw" in text.lower() or b"key" in text or b"token" in text or b"secret" in text:
            yield from _hits(one.path, text.decode("utf-8", "replace"))


def _hits(path: str, text: str) -> Iterator[Hit]:
    """Yield each line of YAML that gives a secret."""
    for number, line in enumerate(text.splitlines(), 1):
        match = _YAML.match(line)
        if match and _is_secret(match[1], match[2]):
            yield Hit("launch.credentials", _message(match[1]), number, context=match[1], path=path)


def _is_secret(name: str, value: str) -> bool:
    return bool(_NAME.search(name)) and len(value) >= 4 and not _NOTHING.match(value)


def _message(name: str) -> str:
    return f"{name!r} has a value in the repository; expected it from the environment or a file outside"


RULE = PackageRule(
    id="launch.credentials",
    title="Password or key in a configuration",
    finds="A parameter or argument named like a password, secret, key or token that has a value, in a launch file "
    "in XML or a YAML file. The value is not repeated in the finding.",
    why="Whoever can read the repository, or a disk image of any robot, has access to all robots; and it cannot be "
    "changed without a release.",
    consequence=Consequence.MAY_BE_WRONG,
    certainty=Certainty.HEURISTIC,
    profiles=("ros2", "ros1"),
    tags=("launch", "security"),
    bad='<param name="mqtt_password" value="kobuki2021"/>',
    good='<param name="mqtt_password" value="$(env MQTT_PASSWORD)"/>',
    found=found,
)
