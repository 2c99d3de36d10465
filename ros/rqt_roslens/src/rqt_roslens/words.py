"""What is written of rows, alerts and details; signs and words go together, colours only repeat them."""

SIGNS = {
    "ok": ("\u2714", "#0072B2"),
    "unjudged": ("\u2013", "#6E7781"),
    "suspended": ("\u2016", "#6E7781"),
    "unknown": ("?", "#6E7781"),
    "low": ("\u25bc", "#B35900"),
    "high": ("\u25b2", "#B35900"),
    "absent": ("\u2716", "#C1440E"),
}
"""Sign and colour of each state."""
_WORDS = {"unjudged": "not judged"}


def state_words(state):
    """Return sign and word of a state."""
    return "{} {}".format(SIGNS.get(state, ("?", ""))[0], _WORDS.get(state, state))


def color_of(state):
    """Return the colour of a state."""
    return SIGNS.get(state, ("", "#6E7781"))[1]


def clean(text):
    """Return text from outside without signs that reorder or control what is read."""
    return "".join(sign if sign.isprintable() else " " for sign in text)


def alert_rows(alerts):
    """Return entity, state and text of each first cause, and under it of what follows from it."""
    found = []
    for one in alerts:
        found.append((one["entity"], one["state"], _alert(one, "")))
        follows = one.get("follows", ())
        found += [(other["entity"], other["state"], _alert(other, "    \u21b3 ")) for other in follows]
    return found


def _alert(one, before):
    said = "{}  {}  {}: {}".format(state_words(one["state"]), one["when"].strip(), one["name"], one["message"])
    return before + clean(said)


def head(snapshot, problem):
    """Return how the robot stands in a line, or why that is not known."""
    if snapshot is None:
        return problem or "waiting for the first look"
    counts = ", ".join(f"{count} {state}" for state, count in snapshot["counts"].items() if count)
    text = "{}  {}  {}".format(snapshot["title"], snapshot["when"].strip(), counts or "nothing is judged")
    return f"NOT CURRENT: {problem}  ({text})" if problem else text


def detail_rows(detail):
    """Return the verdicts of all constraints on an entity: state, signal, value, expected, since, and why in lines."""
    return [
        (
            one["state"],
            one["title"],
            one["value"],
            one["expected"],
            one["since"],
            "\n".join(clean(one[key]) for key in ("evidence", "why", "text", "where") if one.get(key)),
        )
        for one in detail.get("judgements", ())
    ]
