# make run | make test | make viz | make long | make bench | make lint
PYTHON ?= python3
VENV := .venv
BIN := $(VENV)/bin
DATA := data
export OMP_NUM_THREADS ?= 2
export PYTHONUNBUFFERED = 1

.PHONY: run test lint long bench viz viz-page schedule install

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
	$(BIN)/python -m tire_pipeline.lineage.serve

# The same as one page that opens without a server.
viz-page: install
	$(BIN)/kedro viz build --include-previews
	$(BIN)/python -m tire_pipeline.lineage.one_page build $(DATA)/08_reporting/lineage.html
	@rm -rf build

# Retraining when .tir files arrive and every night; http://127.0.0.1:3000
schedule: install
	$(BIN)/python -m pip install --quiet --disable-pip-version-check -e ".[schedule]" -c requirements.lock
	@mkdir -p $(DATA)/.dagster && cp conf/dagster.yaml $(DATA)/.dagster/
	DAGSTER_HOME=$(CURDIR)/$(DATA)/.dagster DO_NOT_TRACK=1 $(BIN)/dagster dev \
		-m tire_pipeline.schedule.definitions -h 127.0.0.1 -p 3000

install: $(VENV)/.installed

$(VENV)/.installed: pyproject.toml requirements.lock
	@test -x $(BIN)/python || $(PYTHON) -m venv $(VENV)
	@echo "Installing (a few minutes the first time)"
	$(BIN)/python -m pip install --quiet --disable-pip-version-check torch==2.13.0 -c requirements.lock
	$(BIN)/python -m pip install --quiet --disable-pip-version-check -e ".[dev]" -c requirements.lock
	@touch $@
