# What a person runs, and what CI runs. Only Python 3.11+ and make are needed; everything goes into .venv.
#   make demo    install, and make the sample furniture work
#   make train-deps   install what only training needs: torch
#   make test    install the development tools, and run the tests
#   make check   lint, formatting, types, layers, pages drawn from code
#   make format  mend formatting and what lint can mend
#   make fuzz    damaged and hostile files through every reader: COUNT cases of SEED, or one again: SEED=15 CASE=1234
#   make bench   speed, memory, growth
#   make figures  every figure that docs/ states, printed anew; FIGURES="--list" says which, --only, --page, --write
#   make site    docs/ as a site in build/site, with a search; a broken link is an error
#   make blender   build the Blender extension: a zip in dist/
#   make clean   remove what these made

PYTHON ?= python3
BIN := .venv/bin
SAMPLE := samples/sideboard.glb

.PHONY: demo train-deps test check format fuzz bench figures site blender clean help
.DEFAULT_GOAL := help

help:
	@sed -n 's/^#   //p' Makefile

.venv/made:
	@$(PYTHON) -c 'import sys; sys.exit(sys.version_info < (3, 11))' || \
	  { echo "Python 3.11 or newer is needed: $$($(PYTHON) --version 2>&1); say make PYTHON=python3.12" >&2; exit 1; }
	$(PYTHON) -m venv .venv
	@touch $@

.venv/installed: .venv/made pyproject.toml
	$(BIN)/python -m pip install --quiet --disable-pip-version-check --editable .
	@$(BIN)/python -m compileall -q src/grafu  # else the first run does that, and each run where Python is told not to
	@touch $@

.venv/installed-dev: .venv/installed
	$(BIN)/python -m pip install --quiet --disable-pip-version-check --editable '.[dev]'
	@touch $@

# Only training needs torch: the build for CPUs where that is to be had, else the usual one; what is there is kept.
.venv/installed-train: .venv/installed
	$(BIN)/python -c 'import torch' 2>/dev/null || \
	  $(BIN)/python -m pip install --quiet --disable-pip-version-check 'torch==2.13.0+cpu' 2>/dev/null || \
	  $(BIN)/python -m pip install --quiet --disable-pip-version-check torch
	$(BIN)/python -m pip install --quiet --disable-pip-version-check --editable '.[train]'
	@touch $@

# In an environment of its own: nothing else needs it.
build/docs-env/installed: pyproject.toml
	$(PYTHON) -m venv build/docs-env
	build/docs-env/bin/python -m pip install --quiet --disable-pip-version-check $$($(PYTHON) -c \
	  'import tomllib; print(*tomllib.load(open("pyproject.toml", "rb"))["project"]["optional-dependencies"]["docs"])')
	@touch $@

site: build/docs-env/installed
	NO_MKDOCS_2_WARNING=1 build/docs-env/bin/mkdocs build --strict --site-dir build/site

train-deps: .venv/installed-train

demo: .venv/installed
	$(BIN)/grafu functionalize $(SAMPLE) --out out --overwrite
	@echo "look: out/sideboard/report.html (any browser), model.glb (animated: any glTF viewer), model.urdf (any robot simulator)"
	@echo "correct by a click: $(BIN)/pip install 'grafu[edit]', then $(BIN)/grafu edit out/sideboard"

# With npm the exported GLBs also pass the Khronos validator, and the types of scripts are checked; without it, or where
# it cannot be fetched, those tests and that check skip.
.venv/installed-validator: .venv/made package.json
	@command -v npm >/dev/null && npm install --no-package-lock --no-audit --no-fund --loglevel=error || true
	@touch $@

test: .venv/installed-dev .venv/installed-train .venv/installed-validator
	$(BIN)/pytest -n auto --dist worksteal

check: .venv/installed-dev .venv/installed-train .venv/installed-validator
	$(BIN)/ruff check src tests scripts examples blender_addon
	$(BIN)/ruff format --check src tests scripts examples blender_addon
	$(BIN)/mypy --num-workers 2
	$(BIN)/lint-imports
	$(BIN)/python scripts/docs.py --check
	$(BIN)/python scripts/check_javascript.py

format: .venv/installed-dev
	$(BIN)/ruff check --fix src tests scripts examples blender_addon
	$(BIN)/ruff format src tests scripts examples blender_addon

COUNT ?= 500
SEED ?= 15
CASE ?=
fuzz: .venv/installed-dev
	PYTHONPATH=tests$(if $(PYTHONPATH),:$(PYTHONPATH)) $(BIN)/python -m fuzz --seed $(SEED) $(if $(CASE),--case $(CASE),--count $(COUNT))

bench: .venv/installed-dev
	$(BIN)/python scripts/bench.py

# Hours, all of them: FIGURES chooses. Real models are those of GRAFU_MODELS; stopped, it goes on where it was.
figures: .venv/installed-dev .venv/installed-train
	$(BIN)/python scripts/figures.py $(FIGURES)

# The wheels of the dependencies are fetched for Blender's Python and go into the zip; none are kept here.
blender: .venv/installed
	$(BIN)/python scripts/build_blender_addon.py

clean:
	rm -rf .venv out bench build dist .pytest_cache .mypy_cache .ruff_cache .import_linter_cache .hypothesis
	find src tests scripts -name __pycache__ -type d -prune -exec rm -rf {} +
