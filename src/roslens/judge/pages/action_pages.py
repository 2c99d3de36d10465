"""The reference pages of actions, one for each kind, generated from their declarations."""

from __future__ import annotations

from roslens.model.acting.action_kind import ACTION_KINDS, ActionKind, Argument, ArgumentType
from roslens.model.entity import EntityKind

_INTRODUCTION = (
    "The actions of [reactions](../reactions.md), and what carries them out. `roslens react` takes no action unless "
    "its `--mode` allows it. `make docs` generates this page from `src/roslens/model/acting/action_kind.py`."
)


def action_pages() -> dict[str, str]:
    """Return the page of each kind of action, and that of all, by its path below the reference."""
    pages = {f"actions/{one.key}.md": action_page(one) for one in ACTION_KINDS}
    rows = [f"| [`{one.key}`]({one.key}.md) | {one.by.value} | {one.summary} |" for one in ACTION_KINDS]
    pages["actions/README.md"] = "\n".join(
        (
            "# Actions",
            "",
            _INTRODUCTION,
            "",
            "| action | carried out by | effect |",
            "| --- | --- | --- |",
            *rows,
            "",
        )
    )
    return pages


def action_page(kind: ActionKind) -> str:
    """Return the page of a kind of action."""
    lines = [f"# `{kind.key}`", "", kind.summary, "", f"Carried out by {kind.by.value}.{_generations(kind)}", ""]
    if kind.targets:
        words = " or ".join(f"`{one.value}`" for one in kind.targets)
        lines += [f"Its target is a {words}, by name or as `{{entity}}`, `{{host}}` or `{{cause}}`.", ""]
    lines += ["```yaml", "do:", f"  - {_example(kind)}", "```", ""]
    if kind.arguments:
        lines += ["| argument | type | default | meaning |", "| --- | --- | --- | --- |"]
        lines += [_row(one) for one in kind.arguments]
        lines += [""]
    if kind.details:
        lines += [kind.details, ""]
    if not kind.touches:
        lines += ["It changes nothing on the robot: `--mode ask` does not ask before it.", ""]
    return "\n".join(lines)


def _generations(kind: ActionKind) -> str:
    return f" Only in ROS {kind.ros[0]}." if len(kind.ros) == 1 else ""


def _row(one: Argument) -> str:
    default = "required" if one.required else _default(one)
    choices = f" ({', '.join(f'`{choice}`' for choice in one.choices)})" if one.choices else ""
    return f"| `{one.name}` | {one.type.value}{choices} | {default} | {one.text} |"


def _default(one: Argument) -> str:
    value = one.default
    if value in (None, "", (), {}):
        return "none"
    if isinstance(value, bool):
        return "`true`" if value else "`false`"
    if isinstance(value, (int, float)):
        return f"`{value:g}{' s' if one.type is ArgumentType.DURATION else ''}`"
    return f"`{value}`" if isinstance(value, str) else ", ".join(f"`{each}`" for each in _listed(value))


def _listed(value: object) -> tuple[object, ...]:
    return tuple(value) if isinstance(value, (list, tuple)) else (value,)


_EXAMPLES = {
    "notify": 'notify: "{entity} is {state}"',
    "webhook": 'webhook: {url: "https://example.org/robot", text: "{entity} is {state}"}',
    "publish": "publish: {topic: /emergency_stop, type: std_msgs/msg/Bool, fields: {data: true}, how: repeated}",
    "call": "call: {service: /motors/enable, type: std_srvs/srv/SetBool, fields: {data: false}}",
    "set_parameter": "set_parameter: {node: /planner, name: max_speed, value: 0.2}",
    "lifecycle": "lifecycle: {node: /arm, transition: deactivate}",
    "unload": "unload: {node: /camera, container: /container}",
    "load": 'load: {container: /container, package: image_proc, plugin: "image_proc::RectifyNode", name: rectify}',
    "restart": 'restart: {node: "{entity}", grace: 3 s}\n    verify: 10 s',
    "command": "command: {host: base, name: power_cycle}",
    "record": 'record: {topics: ["/scan", "/camera/**"], before: 10 s, after: 5 s}',
    "snapshot": "snapshot: {}",
}


def _example(kind: ActionKind) -> str:
    known = _EXAMPLES.get(kind.key)
    return (
        known if known is not None else f'{kind.key}: {{{(kind.targets or (EntityKind.NODE,))[0].value}: "{{entity}}"}}'
    )
