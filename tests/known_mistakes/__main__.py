"""Writes docs/known_mistakes.md: PYTHONPATH=tests .venv/bin/python -m known_mistakes."""

from known_mistakes.page import PAGE, page

PAGE.write_text(page())
