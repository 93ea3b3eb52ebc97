# Each target sets up what it needs in .venv. A sourced ROS stays out of it: two ROS in one process do not mix.
unexport AMENT_PREFIX_PATH COLCON_PREFIX_PATH LD_LIBRARY_PATH PYTHONPATH _ROS_WHEELS_BOOTSTRAP_COMPLETE
export ROS_AUTOMATIC_DISCOVERY_RANGE ?= LOCALHOST

PYTHON ?= python3
VENV := .venv
BIN := $(VENV)/bin
LOCK := requirements.lock
# Tests of nodes wait for half of their time: three workers fill two cores.
WORKERS ?= 3
NOBLE_EXTRAS := analysis bags cluster colcon fast gymnasium pandas parquet pictures ros test
# Ubuntu 24.04's Python where one runs (a shim of pyenv may not), else the Python there is.
NOBLE_PYTHON = $(shell for python in python3.12 $(HOME)/.pyenv/versions/3.12*/bin/python3.12 $(PYTHON); do \
  "$$python" -c "" 2>/dev/null && echo "$$python" && break; done)

.PHONY: help setup sim test test-noble test-fast soak bench bench-memory lint docs pages moving-picture reproduction parameters lock clean

help:  ## say what the targets do
	@grep -E '^[a-z-]+:.*##' $(MAKEFILE_LIST) | sed -E 's/:.*## /\t/' | expand -t 14

setup: $(VENV)/ready  ## install the package and its tools, versions as locked, in .venv

$(VENV)/ready: $(LOCK) setup.py setup.cfg pyproject.toml $(wildcard resource/commands/*)
	@$(PYTHON) -c 'import sys; sys.exit(not (3, 11) <= sys.version_info < (3, 13))' \
	  || { echo "yawdamp_ros: $(PYTHON) is not Python 3.11 or 3.12; say make PYTHON=python3.11" >&2; exit 1; }
	@$(PYTHON) -m venv $(VENV) || { echo "yawdamp_ros: install python3-venv first" >&2; exit 1; }
	@echo "Installing into $(VENV) (once, about a minute) ..."
	@$(BIN)/python -m pip install --quiet --disable-pip-version-check -r $(LOCK)
	@$(BIN)/python -m pip install --quiet --disable-pip-version-check --no-deps --no-build-isolation --editable .
	@$(BIN)/python -m compileall -q yawdamp_ros
	@$(BIN)/python -m yawdamp_ros.nonlinear.warm_up
	@touch $@

sim: setup  ## drive the interlink one lane (3.5 m) to the left in 15 s and record it
	@$(BIN)/python -m yawdamp_ros sim --vehicle interlink --manoeuvre lane_change --amplitude 0.018 --duration 15

test: setup  ## run every test
	@$(BIN)/python -m pytest -n $(WORKERS) --dist loadfile

test-noble:  ## run every test with Ubuntu 24.04's versions, in .venv-noble
	@$(MAKE) --no-print-directory test PYTHON=$(NOBLE_PYTHON) VENV=.venv-noble LOCK=requirements-noble.lock

test-fast: setup  ## run the tests that need no ROS graph
	@$(BIN)/python -m pytest -m "not graph"

soak: setup  ## run the long tests, about half an hour; each says what it saw
	@$(BIN)/python -m pytest test/soak

bench: setup  ## measure the ratios of the manual's performance page, about half an hour on an idle machine
	@$(BIN)/python bench/run.py

bench-memory: setup  ## measure the node's memory over ten minutes at 1 kHz
	@$(BIN)/python bench/run.py memory

lint: setup  ## ruff, mypy and the layering
	@$(BIN)/ruff check .
	@$(BIN)/ruff format --check .
	@$(BIN)/mypy
	@MYPYPATH=docs $(BIN)/mypy --explicit-package-bases docs/reproduce.py docs/reproduction docs/parameter_table.py docs/reference_pages.py docs/pages.py docs/moving_picture.py
	@$(BIN)/lint-imports --no-cache

docs: setup  ## build the manual into docs/_build/html; a warning is an error
	@$(BIN)/python -m sphinx -q -W --keep-going -b html docs docs/_build/html
	@echo "docs/_build/html/index.html"

pages: setup  ## execute the pages of the manual and renew the outputs that they show
	@$(BIN)/python docs/pages.py

moving-picture: setup  ## write docs/jackknife.gif
	@$(BIN)/python docs/moving_picture.py

reproduction: setup  ## write docs/report_reproduction.md and the pictures of docs/ from the code
	@$(BIN)/python docs/reproduce.py

parameters: setup  ## write the node's parameters into config/sim.yaml, and the schema for editors
	@$(BIN)/python docs/parameter_table.py
	@$(BIN)/python -m yawdamp_ros.vehicle.editor_schema

lock: setup  ## renew requirements.lock and requirements-noble.lock
	@$(BIN)/python -m pip install --quiet --disable-pip-version-check uv
	@$(BIN)/uv pip compile --quiet --universal --upgrade --python-version 3.11 --all-extras --no-header \
	  --no-emit-index-url --no-annotate setup.py --output-file requirements.lock
	@$(BIN)/uv pip compile --quiet --universal --upgrade --python-version 3.11 $(NOBLE_EXTRAS:%=--extra %) \
	  --constraint requirements-noble.in --no-header --no-emit-index-url --no-annotate setup.py \
	  --output-file requirements-noble.lock

clean:  ## remove what the targets made, but for recorded runs
	@rm -rf $(VENV) .venv-noble build install log *.egg-info .mypy_cache .pytest_cache .ruff_cache .hypothesis docs/_build
