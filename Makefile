# The commands to learn: demo, test, quick, lint, bench, docs.
PYTHON ?= python3
BIN := .venv/bin

.PHONY: demo test quick lint parts docs bench clean

.venv/stamp: pyproject.toml requirements.lock
	PYTHON=$(PYTHON) sh .ci/venv
	touch $@

lint: .venv/stamp
	$(BIN)/ruff check
	$(BIN)/ruff format --check
	$(BIN)/mypy
	$(BIN)/lint-imports

quick: lint
	$(BIN)/pytest -m "not slow and not real and not browser"
