# make demo   run a spur pair: record, summary, picture and a page for the browser in ./demo
# make test   lint, types and all tests, the slow ones and the speed ratios included
# make quick  the shortest tests, under a minute (docs/development.md)
# make soak   512 random drives, duties and options, and other long checks: two hours (docs/soak.md)
# make fuzz   30 000 mutated inputs: scenarios, options, curves, records, the cache (docs/fuzz.md)
# make elsewhere  the tests as on other machines: other BLAS, vectors, compilers' targets, threads, load (an hour)
# make docs   the documentation site, into docs/_build/html
# make wheel  what a package index gets, into dist: wheel and source distribution, checked
# make durations  measure the tests anew: which are the quick ones, in which order all run
PYTHON ?= python3
# two test processes share the cores; a BLAS's own threads would only stand in their way
export OPENBLAS_NUM_THREADS ?= 1
# the tests start hundreds of processes, and each would compile what it imports
unexport PYTHONDONTWRITEBYTECODE
# the tests run XLA's programs once or twice: its older code generator makes them in a third to a half of the time
TESTS_XLA := --xla_cpu_use_fusion_emitters=false
# a file's tests share what it prepares; the longest files come first (tests/durations.json)
IN_PARALLEL := -n 2 --dist loadfile --no-loadscope-reorder --benchmark-disable
VENV := .venv
BIN := $(VENV)/bin
# the constraints also hold for what builds the package
INSTALL := PIP_CONSTRAINT=$(CURDIR)/constraints.txt $(BIN)/python -m pip install --quiet --disable-pip-version-check --no-compile
# what pip does on one core; not of what nothing imports
BYTECODE := $(BIN)/python -m compileall -q -j 0 -x '/(tests?|plotly)/' $(VENV)/lib > /dev/null 2>&1 || true

.PHONY: demo docs test quick soak fuzz elsewhere durations lint types tests in-parallel ratios wheel clean

demo: $(VENV)/.installed
	@mkdir -p demo
	$(BIN)/tribodyn run spur-25-51 --force --report --output demo/spur-25-51.h5
	@echo
	@echo "Next, type one of:"
	@echo "  $(BIN)/tribodyn list                                       what there is to run"
	@echo "  $(BIN)/tribodyn plot demo/spur-25-51.h5 all -o demo    all figures of this run"
	@echo "  $(BIN)/tribodyn init my-drive                              a gear pair of your own, to edit"
	@echo "  source $(BIN)/activate                                    then tribodyn needs no path"

# the types are checked beside the tests and reported after them
test: lint
	@$(MAKE) --no-print-directory types > $(VENV)/types.txt 2>&1 & types=$$!; \
	  $(MAKE) --no-print-directory in-parallel; tests=$$?; \
	  wait $$types; types=$$?; cat $(VENV)/types.txt; [ $$tests$$types = 00 ]
	@$(MAKE) --no-print-directory ratios

lint: $(VENV)/.testing
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .

# nothing to do where they passed with the same sources
types: $(VENV)/.testing
	@$(BIN)/python -m tests.support.checked_types

tests: in-parallel ratios

in-parallel: $(VENV)/.testing
	@for what in single trains lanes; do $(BIN)/python -m tests.support.shared_kernels $$what > /dev/null 2>&1 & done; wait
	XLA_FLAGS="$(TESTS_XLA)" $(BIN)/python -m pytest $(IN_PARALLEL) -m "not bench" $(CHOSEN)

# alone: never beside other tests
ratios: $(VENV)/.testing
	$(BIN)/python -m pytest -m bench tests/bench

quick: $(VENV)/.testing
	XLA_FLAGS="$(TESTS_XLA)" $(BIN)/python -m pytest $(IN_PARALLEL) --quick -m "not bench and not slow"

soak: $(VENV)/.testing
	@XLA_FLAGS="$(TESTS_XLA)" nice $(BIN)/python -m pytest $(IN_PARALLEL) -m "soak and not bench"; tests=$$?; \
	  $(BIN)/python -m tools.soak --so-far --into docs/soak.md; cases=$$?; \
	  $(BIN)/python -m pytest -m "soak and bench" tests/bench; ratios=$$?; [ $$tests$$cases$$ratios = 000 ]

fuzz: $(VENV)/.testing
	nice $(BIN)/python -m tools.fuzz --jobs 2 --into docs/fuzz.md

# twice: where the first user of something expensive is not quick, the next one prepares it
durations: $(VENV)/.testing
	XLA_FLAGS="$(TESTS_XLA)" $(BIN)/python -m pytest $(IN_PARALLEL) --measure-durations -m "not bench"
	XLA_FLAGS="$(TESTS_XLA)" $(BIN)/python -m pytest $(IN_PARALLEL) --measure-durations --quick -m "not bench and not slow"

elsewhere: $(VENV)/.testing
	$(BIN)/python -m tools.elsewhere --write

docs: $(VENV)/.documenting
	$(BIN)/python -m sphinx --fail-on-warning --keep-going --fresh-env -b html docs docs/_build/html
	@echo "Open docs/_build/html/index.html"

wheel: $(VENV)/.testing
	$(BIN)/python -m build --outdir dist
	$(BIN)/python -m twine check --strict dist/*

$(VENV)/.created:
	@$(PYTHON) -c 'import sys; sys.exit(sys.version_info < (3, 11))' \
	  || { echo "tribodyn needs Python 3.11 or newer: make PYTHON=python3.12 ..."; exit 1; }
	$(PYTHON) -m venv $(VENV)
	@touch $@

$(VENV)/.installed: $(VENV)/.created pyproject.toml constraints.txt
	$(INSTALL) --editable .
	@$(BYTECODE)
	@touch $@

# machine code for the tests is made meanwhile, for which nothing of it is needed
$(VENV)/.testing: $(VENV)/.installed
	@$(BIN)/python -m tests.support.shared_kernels lanes > /dev/null 2>&1 & \
	  $(INSTALL) --editable ".[test]" && wait
	@$(BYTECODE)
	@touch $@

$(VENV)/.documenting: $(VENV)/.installed
	$(INSTALL) --editable ".[docs]"
	@touch $@

clean:
	rm -rf $(VENV) demo dist docs/_build .pytest_cache .ruff_cache .hypothesis
