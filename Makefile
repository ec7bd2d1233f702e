# make run | make cluster | make quick | make test | make checks | make test-and-checks | make docs | make viz | make long | make bench | make lint | make coverage | make audit | make build | make schedule
PYTHON ?= python3
VENV := .venv
BIN := $(VENV)/bin
DATA := data
DIST := dist
EXTRAS ?= dev
COMMA := ,
export OMP_NUM_THREADS ?= 2
export PYTHONUNBUFFERED = 1
# What is imported is compiled once, not by each process that a command or a test starts.
unexport PYTHONDONTWRITEBYTECODE
# Two processes, each file of tests in one of them, by tests/conftest.py.
TWO := -n 2 --dist loadfile --no-loadscope-reorder

.PHONY: run cluster quick test checks test-and-checks docs lint long bench coverage audit build sbom viz viz-page schedule install

run: install
	@if [ -z "$$(find -L $(DATA)/01_raw/tir -iname '*.tir' -print -quit 2>/dev/null)" ]; then \
		echo "No .tir files in $(DATA)/01_raw/tir: making the demonstration fleet"; \
		$(BIN)/kedro run --pipeline make_fleet; \
	fi
	$(BIN)/kedro run

# For daily work. Run the tests of the folder that you changed besides.
quick: install
	OMP_NUM_THREADS=1 $(BIN)/python -m pytest -m "not slow and not ci and not long" $(TWO)

# Every public behaviour, by the cheapest test that shows it.
test: install
	OMP_NUM_THREADS=1 $(BIN)/python -m pytest -m "not ci and not long" $(TWO)

# What CI runs besides: more cases, whole runs, real recordings (tests/ci_only.txt).
checks: install
	OMP_NUM_THREADS=1 $(BIN)/python -m pytest -m "ci and not long" $(TWO)

# Both in one go, as CI does: what their tests share is made once.
test-and-checks: install
	OMP_NUM_THREADS=1 $(BIN)/python -m pytest -m "not long" $(TWO)

# Rates over many cases, and runs of an hour.
long: install
	$(BIN)/python -m pytest -m long

lint: install
	$(BIN)/ruff check --no-cache .
	$(BIN)/ruff format --check .
	$(BIN)/mypy
	$(BIN)/lint-imports

# The domain folders, at least 90% together; then folder by folder.
coverage: install
	$(BIN)/python -m pytest -m "not long" --cov --cov-report=term
	@for folder in src/tire_pipeline/*/; do \
		total=$$($(BIN)/coverage report --fail-under=0 --format=total --include="$$folder*" 2>/dev/null) \
			&& echo "$$folder $$total%"; \
	done; true

# The documentation as a site that opens from a file, without a network: site/index.html
docs: install
	@$(BIN)/python -c "import mkdocs, material" 2>/dev/null || \
		$(BIN)/python tools/install.py -e ".[docs]" -c requirements.lock
	NO_MKDOCS_2_WARNING=1 $(BIN)/mkdocs build --strict --quiet
	@echo "Open site/index.html"

# Known vulnerabilities of the pinned versions, by a database on this machine: docs/how-to/audit.md
# make audit ADVISORIES=all.zip; make ends every failure with code 2, tools/audit.sh all.zip tells them apart.
audit:
	@VENV=$(VENV) PYTHON=$(PYTHON) tools/audit.sh $(if $(ADVISORIES),"$(ADVISORIES)")

# The wheel, and the list of components that it was tested with, beside it.
build: install sbom
	@rm -rf build
	$(BIN)/python -m pip wheel --quiet --disable-pip-version-check --no-deps --wheel-dir $(DIST) .

# CycloneDX 1.6, checked against its schema.
sbom: install
	@mkdir -p $(DIST)
	$(BIN)/python -m cyclonedx_py requirements requirements.lock --pyproject pyproject.toml --output-reproducible --validate --of JSON -o $(DIST)/tire-pipeline.cdx.json

bench: install
	@for file in benchmarks/bench_*.py; do echo "== $$file"; $(BIN)/python $$file || exit 1; done

viz: install
	$(BIN)/python -m tire_pipeline.lineage.serve

# The same as one page that opens without a server.
viz-page: install
	PYTHONWARNINGS="ignore:ORJSONResponse is deprecated" $(BIN)/kedro viz build --include-previews
	$(BIN)/python -m tire_pipeline.lineage.one_page build $(DATA)/08_reporting/lineage.html
	@rm -rf build

# A Dask scheduler and two workers of one thread on this machine, for `kedro run --env cluster`; Ctrl-C ends them.
# Loopback only: Dask runs whatever it is sent. Its dashboard: http://127.0.0.1:8787
cluster: install
	@echo "scheduler tcp://127.0.0.1:8786, dashboard http://127.0.0.1:8787"
	@export DASK_DISTRIBUTED__SCHEDULER__ALLOWED_FAILURES=2; \
	$(BIN)/python -m dask scheduler --host 127.0.0.1 --port 8786 --dashboard-address 127.0.0.1:8787 & scheduler=$$!; \
	$(BIN)/python -m dask worker tcp://127.0.0.1:8786 --host 127.0.0.1 --nworkers 2 --nthreads 1 \
		--memory-limit 1.5GiB --dashboard-address 127.0.0.1:0 & workers=$$!; \
	trap 'kill $$workers $$scheduler 2>/dev/null; wait' INT TERM EXIT; wait

# Retraining when .tir files arrive and every night; http://127.0.0.1:3000
# With DAGSTER_POSTGRES_URL in the environment Dagster keeps its runs in Postgres: docs/how-to/cluster.md
schedule: install
	@$(BIN)/python tools/install.py -c requirements.lock \
		-e ".[schedule$(if $(DAGSTER_POSTGRES_URL),$(COMMA)postgres)]"
	@mkdir -p $(DATA)/.dagster
	@cat conf/dagster.yaml $(if $(DAGSTER_POSTGRES_URL),conf/dagster_postgres.yaml) > $(DATA)/.dagster/dagster.yaml
	DAGSTER_HOME=$(CURDIR)/$(DATA)/.dagster DO_NOT_TRACK=1 $(BIN)/dagster dev \
		-m tire_pipeline.schedule.definitions -h 127.0.0.1 -p 3000

install: $(VENV)/.installed

$(VENV)/.installed: pyproject.toml requirements.lock
	@test -x $(BIN)/python || $(PYTHON) -m venv $(VENV)
	@echo "Installing into $(VENV): a few minutes the first time, longer beside other work"
	@$(BIN)/python tools/install.py torch==2.13.0 -c requirements.lock
	@$(BIN)/python tools/install.py -e ".[$(EXTRAS)]" -c requirements.lock
	@touch $@
