# make book   build the book into build/_build/html
# make test   check everything: style, package, notebooks, built pages
# make test-core  check the method only, in half a minute
# make test-browsers  compare all scenes in Chromium, Firefox and WebKitGTK,
#   from a file and from a server
# make lab    open the notebooks, with solutions, in JupyterLab
# make lab-student  open the student edition there
# make pdf    print the book to build/abstransfer.pdf; needs Chromium
# make slides  build the book, and say where its slides for the wall are
# make student  write the student edition, with blanks, into build/student
# make zip    pack the built book and the student edition into build, with checksums
# make nightly  the long forms of the tests that draw what happens, an hour; Run All of
#   each page for students; a class of sixty; the graders' own tools; whether all that
#   is pinned can be had for each Python
# make exits  build the book with Sphinx alone, and with the newest versions: the way out
#   of Jupyter Book 1, which is only maintained
# make bench  measure the learning loops beside other people's, and the pages
# make clean  remove what these made
#
# The only need is Python 3.11 or newer; to choose one: make book PYTHON=python3.12

PYTHON ?= python3
# What a file is compiled to is kept: tests start hundreds of processes.
unexport PYTHONDONTWRITEBYTECODE
HERE := $(shell cd "$$(dirname "$(strip $(MAKEFILE_LIST))")" && pwd -P)
BIN := .venv/bin
PIP := $(BIN)/python -m pip install --quiet --disable-pip-version-check -c constraints.txt
# uv takes a tenth of pip's time, but does not read its settings, a mirror for instance;
# so what it cannot install is left to pip.
comma := ,
install = $(PIP) uv && { \
  $(BIN)/uv pip install --quiet --python $(BIN)/python -c constraints.txt $(1) || $(PIP) $(1); }
DENO := DENO_DIR=.venv/share/deno $(BIN)/deno
# The tests of a file share what is costly to make, so a file stays in one process.
# The third process has work while another waits for a browser.
PYTEST := $(BIN)/python -m pytest --quiet -n 3 --dist loadfile --no-loadscope-reorder \
  --durations=15 --durations-min=5
PYTHONS := 3.11 3.12 3.13 3.14 # for which there must be wheels of all that is pinned
CORE := $(addprefix tests/,core builders learning) $(wildcard abstransfer/[a-z]*.py) \
  $(addprefix abstransfer/,builders learning)

.PHONY: book test test-core test-browsers nightly exits lab lab-student pdf slides student zip bench clean env style loops system
.DEFAULT_GOAL := book

ifneq ($(HERE),$(CURDIR)) # called as make -f path/Makefile: go there

book test test-core test-browsers nightly exits lab lab-student pdf slides student zip bench clean env style loops system:
	@$(MAKE) --no-print-directory -C "$(HERE)" $@

else

# An environment that was made elsewhere, then copied or moved, is made again.
ifneq ($(shell cat .venv/.made-in 2>/dev/null),$(HERE))
$(shell rm -f .venv/.book .venv/.lab)
endif

env: .venv/.book

.venv/.book: pyproject.toml constraints.txt
	@$(PYTHON) -c 'import sys; sys.exit(sys.version_info < (3, 11))' || { \
	  echo "abstransfer needs Python 3.11 or newer. Install it, then say for" \
	       "instance: make PYTHON=python3.12"; exit 1; }
	test "$$(cat .venv/.made-in 2>/dev/null)" = "$(HERE)" || $(PYTHON) -m venv --clear .venv
	$(call install,--editable ".[test]")
	@echo "$(HERE)" > .venv/.made-in
	@touch $@

.venv/.lab: .venv/.book
	$(call install,--editable ".[test$(comma)lab]")
	@touch $@

# From an empty folder: a second build would not repeat the warnings of the first.
book: .venv/.book
	rm -rf build/_build
	$(BIN)/jupyter-book build book --config _config.yml --path-output build -W -n --keep-going
	@echo
	@echo "The book is built. Open this file in a browser:"
	@echo "  $(HERE)/build/_build/html/index.html"

test:
	@$(MAKE) --no-print-directory -j2 .venv/.book system
	@$(MAKE) --no-print-directory -j2 book style loops
	$(PYTEST)

style: .venv/.book
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .
	$(BIN)/python abstransfer/scenes/bundle.py
	$(DENO) fmt --check
	$(DENO) lint
	$(DENO) check abstransfer book/_ext

# Beside the book, whose build keeps one processor busy; or each process of the tests
# would compile for itself.
loops: .venv/.book
	$(BIN)/python scripts/compile_loops.py

# For a patch to the method: maps to learning, with the examples of their docstrings.
test-core: .venv/.book
	$(PYTEST) -m "not slow" $(CORE)

# `make test` does it too, from a file only, where both are installed (Debian: 110 MB).
test-browsers: .venv/.book system
	@if ! command -v firefox-esr >/dev/null || ! command -v WebKitWebDriver >/dev/null \
	  || ! command -v Xvfb >/dev/null; then \
	  as_root=$$(test "$$(id -u)" = 0 || echo sudo); \
	  $$as_root apt-get update -qq && \
	  $$as_root apt-get install -y -qq --no-install-recommends \
	    firefox-esr webkit2gtk-driver xvfb; fi
	$(BIN)/python abstransfer/scenes/bundle.py
	SERVED=1 $(BIN)/python -m pytest --quiet tests/scenes/test_engines.py

# What is killed, filled up, interrupted or asked for at random; one after another,
# for an interrupt is meant for one.
nightly: .venv/.book system
	DISTURBANCES=250 INTERRUPTS=100 $(BIN)/python -m pytest --quiet --capture=tee-sys \
	  tests/experiments/test_store.py tests/cli/test_interrupts.py \
	  tests/scenes/test_addresses.py
	EVERY_PAGE=1 $(BIN)/python -m pytest --quiet -k run_all \
	  tests/book/test_student_edition.py
	$(BIN)/python scripts/class_trial.py build/trial
	$(PYTHON) -m venv .venv/graders
	.venv/graders/bin/python -m pip install --quiet -c constraints.txt -e ".[book,grading]"
	GRADERS="$(HERE)/.venv/graders/bin" $(BIN)/python -m pytest --quiet \
	  tests/classroom/test_graders.py
	for version in $(PYTHONS); do \
	  $(BIN)/uv pip compile pyproject.toml --extra test --extra lab --extra grading -c constraints.txt \
	    --python-version $$version --only-binary :all: --quiet > /dev/null || exit 1; \
	done

# In a copy, for the settings become a file of it.  Sphinx alone must do without a
# warning; what the newest versions say is told only, for it changes from day to day.
COPY := build/exits
exits: .venv/.book
	rm -rf $(COPY) && mkdir -p $(COPY)
	git ls-files -z | xargs -0 tar cf - | tar xf - -C $(COPY)
	cd $(COPY) && "$(HERE)/$(BIN)/jupyter-book" config sphinx book --config _config.yml \
	  && mv conf.py book/ && PYTHONPATH=.:book/_ext \
	  "$(HERE)/$(BIN)/sphinx-build" -W --keep-going -n -q -b html book out
	$(PYTHON) -m venv --clear $(COPY)/newest
	$(COPY)/newest/bin/python -m pip install --quiet "$(COPY)[test]"
	cd $(COPY) && newest/bin/jupyter-book build book --config _config.yml \
	  --path-output newest-book -n --keep-going --quiet || echo "The newest versions fail."

# On a build server the browser comes from the system's packages and no test is
# skipped; elsewhere the tests that need it say how to get it.
system:
ifdef CI
	@if ! command -v chromium-headless-shell >/dev/null; then \
	  as_root=$$(test "$$(id -u)" = 0 || echo sudo); \
	  $$as_root apt-get update -qq && \
	  $$as_root apt-get install -y -qq --no-install-recommends \
	    chromium-headless-shell fonts-dejavu; fi
endif

bench: .venv/.book
	$(call install,--editable ".[peers]")
	$(BIN)/python benchmarks/run.py
	$(BIN)/python benchmarks/pages.py

# First look for the browser: the book takes a while to build.
pdf: .venv/.book
	@$(BIN)/python scripts/pdf.py --check
	@$(MAKE) --no-print-directory book
	@$(BIN)/python scripts/pdf.py

slides: book
	@echo "Open the slides: $(HERE)/build/_build/html/slides.html"

student: .venv/.book
	$(BIN)/python scripts/student_edition.py build/student

# To hand out: a zip of each, beside its checksum.
zip: book student
	cd build && rm -f abstransfer-*.zip* && ../$(BIN)/python -c "import shutil; \
	  shutil.make_archive('abstransfer-book', 'zip', '_build/html'); \
	  shutil.make_archive('abstransfer-student', 'zip', 'student')" && \
	  for file in abstransfer-*.zip; do sha256sum $$file > $$file.sha256; done

# Trusted, or JupyterLab would not show the stored pictures.
lab: .venv/.lab
	@echo "These pages hold the solutions. To solve the exercises: make lab-student"
	$(BIN)/jupyter-trust book/*.ipynb
	$(BIN)/jupyter-lab book

# What was written there before is kept.
lab-student: .venv/.lab
	test -d build/student || $(MAKE) --no-print-directory student
	$(BIN)/jupyter-trust build/student/*.ipynb
	$(BIN)/jupyter-lab build/student

clean:
	rm -rf .venv build dist .pytest_cache .ruff_cache .hypothesis

endif
