# make run    set up and watch the robot drive the demonstration field
# make test   linters, types, contracts and the tests but for the long ones
# make test-long      longer forms of what `make test` covers: whole missions, more crops, more kinds of recordings
# make test-lowest    the tests with the lowest versions that pyproject.toml allows, in an environment of their own
# make test-backends  SocketCAN and RTSP, with what Debian's packages offer; says what it lacks, installs nothing
# make test-package   builds sdist and wheel; the wheel, alone in an environment of its own, drives a lane
# make clean  remove what these made
# What the tests of a file share is made once: they go to one process, hence --dist loadfile.
# The only needs are Python 3.11 or newer and make. PYTHON=python3.12 names another interpreter.

PYTHON ?= python3
BIN := .venv/bin
PIP := $(BIN)/python -m pip --quiet --disable-pip-version-check

LOWEST := .venv-lowest/bin
PACKAGE := .venv-package/bin
TWO_AT_ONCE := -n 2 --dist loadfile
SHORT := $(TWO_AT_ONCE) -m "not long"
# The share of the tests that CI runs with the lowest versions: what leans on other packages most, in a minute.
LOWEST_SHARE := tests/settings/test_wrong_input.py tests/drivers/test_thorvald.py tests/drivers/test_can_log.py \
	tests/recording/test_schemas.py tests/recording/test_foxglove.py tests/states/test_diagram.py \
	tests/cli/test_detect.py tests/cli/test_simulate.py tests/replay/foreign/test_refused.py \
	tests/drivers/test_can_log_line.py tests/replay/foreign/test_bags.py tests/cli/test_bench.py

.PHONY: run test test-long test-lowest test-lowest-share test-backends test-package clean
.DELETE_ON_ERROR:

run: .venv/installed
	$(BIN)/fieldnav simulate demo

test: .venv/installed-dev
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .
	$(BIN)/mypy
	$(BIN)/lint-imports
	$(BIN)/pytest $(SHORT)

test-long: .venv/installed-dev
	$(BIN)/pytest $(TWO_AT_ONCE) -m long

test-lowest: .venv-lowest/installed
	$(LOWEST)/pytest $(SHORT)

test-lowest-share: .venv-lowest/installed
	$(LOWEST)/pytest $(SHORT) $(LOWEST_SHARE)

test-backends: .venv/installed-dev
	$(BIN)/pytest -v -rs tests/backends/test_rtsp.py
	tests/backends/machine.sh $(BIN)/pytest -v -rs -p no:cacheprovider tests/backends/test_socketcan.py

test-package:
	rm -rf dist
	$(PYTHON) -m venv --clear .venv-package
	$(PACKAGE)/python -m pip --quiet --disable-pip-version-check install build
	$(PACKAGE)/python -m build --outdir dist
	$(PACKAGE)/python -m pip --quiet --disable-pip-version-check install dist/*.whl
	cd dist && ../$(PACKAGE)/fieldnav --version
	cd dist && ../$(PACKAGE)/fieldnav simulate demo --lanes 1 --length 4 --sketch

clean:
	rm -rf .venv .venv-lowest .venv-package .pytest_cache .mypy_cache .ruff_cache .hypothesis .import_linter_cache dist

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

# uv resolves the lowest versions of what pyproject.toml names itself, and the newest of what those need.
.venv-lowest/installed: pyproject.toml
	$(PYTHON) -m venv --clear .venv-lowest
	$(LOWEST)/python -m pip --quiet --disable-pip-version-check install uv
	$(LOWEST)/uv pip install --quiet --python $(LOWEST)/python --resolution lowest-direct --editable '.[dev]'
	@touch $@
