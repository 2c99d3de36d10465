"""Write docs/why.md anew: PYTHONPATH=tests python -m pains."""

from pains.page import PAGE, written

PAGE.write_text(written(PAGE.read_text("utf-8")), "utf-8")
