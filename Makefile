# make run    set up and watch the robot drive the demonstration field
# make test   everything that CI checks
# make clean  remove what these made
# The only needs are Python 3.11 or newer and make. PYTHON=python3.12 names another interpreter.

PYTHON ?= python3
BIN := .venv/bin
PIP := $(BIN)/python -m pip --quiet --disable-pip-version-check

.PHONY: run test clean
.DELETE_ON_ERROR:

run: .venv/installed
	$(BIN)/fieldnav simulate demo

test: .venv/installed-dev
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .
	$(BIN)/mypy
	$(BIN)/lint-imports
	$(BIN)/pytest -n 2

clean:
	rm -rf .venv .pytest_cache .mypy_cache .ruff_cache .hypothesis .import_linter_cache dist

# Made anew only when pyproject.toml changes; the code itself is installed editable.
.venv/installed: pyproject.toml
	@$(PYTHON) -c 'import sys; sys.exit(sys.version_info < (3, 11))' 2>/dev/null || \
		{ echo "error: fieldnav needs Python 3.11 or newer; name one with: make PYTHON=python3.12" >&2; exit 1; }
	$(PYTHON) -m venv --clear .venv
	$(PIP) install --editable .
	@touch $@

.venv/installed-dev: .venv/installed
	$(PIP) install --editable '.[dev]'
	@touch $@
