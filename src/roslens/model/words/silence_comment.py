"""The comment that leaves out one finding of a rule, in the language that the rule reads."""

from __future__ import annotations

from roslens.model.finding import RuleInfo


def silence_comment(rule: RuleInfo) -> str:
    """Return the comment, with a place for the reason."""
    text = f"roslens: ignore[{rule.id}] reason"
    if rule.languages in {("python",), ("cmake",)} or rule.id.startswith("cmake."):
        return f"# {text}"
    if rule.languages == ("cpp",):
        return f"// {text}"
    if rule.languages or rule.id.startswith(("graph.", "launch.")):
        # In the comments of the language of the line: source, launch file or file of parameters.
        return text
    return f"<!-- {text} -->"


def measured_text(rule: RuleInfo) -> str:
    """Return how many findings of a rule that were read were true; empty where nobody read any."""
    if not rule.read:
        return ""
    true = round(rule.precision * rule.read)
    where = "in repositories that it was not written for"
    return f"{true} of {rule.read} findings that were read {where} were true"
