# make run | make test | make viz | make long | make bench | make lint
PYTHON ?= python3
VENV := .venv
BIN := $(VENV)/bin
DATA := data
export OMP_NUM_THREADS ?= 2
export PYTHONUNBUFFERED = 1

.PHONY: run test lint long bench viz install

run: install
	@if [ -z "$$(find $(DATA)/01_raw/tir -iname '*.tir' -print -quit 2>/dev/null)" ]; then \
		echo "No .tir files in $(DATA)/01_raw/tir: making the demonstration fleet"; \
		$(BIN)/kedro run --pipeline make_fleet; \
	fi
	$(BIN)/kedro run

test: install
	$(BIN)/python -m pytest -m "not long"

long: install
	$(BIN)/python -m pytest -m long

lint: install
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .
	$(BIN)/mypy
	$(BIN)/lint-imports

bench: install
	@for file in benchmarks/bench_*.py; do echo "== $$file"; $(BIN)/python $$file || exit 1; done

viz: install
	$(BIN)/kedro viz run --host 127.0.0.1

install: $(VENV)/.installed

$(VENV)/.installed: pyproject.toml requirements.lock
	@test -x $(BIN)/python || $(PYTHON) -m venv $(VENV)
	@echo "Installing (a few minutes the first time)"
	$(BIN)/python -m pip install --quiet --disable-pip-version-check torch==2.13.0 -c requirements.lock
	$(BIN)/python -m pip install --quiet --disable-pip-version-check -e ".[dev]" -c requirements.lock
	@touch $@
