# make demo    two databases, pictures, a sea state, a mooring study; into demo/
# make test    ruff and all tests, in two processes (PROCESSES=1 in one)
# make test-quick   what the change of this branch touches, the nearest tests first, in two minutes
# make test-nojit   kernels as plain Python (a subset); make test-bounds: with array bounds checked
# make test-ends    kernels with the oldest numba, numpy and scipy that are supported, and with the newest
# make test-kernels the two subsets above, where the change of this branch touches kernels
# make bench   error against time beside capytaine and HAMS, into bench/ (20 to 40 minutes; QUICK=1 a minute)
# make docs    the guide with search, keys, API and notebooks, into build/guide; make docs-serve shows it as it is written
# make lint    ruff and the spelling alone; make types: pyright on the public names
# make lock    writes the versions of .venv into requirements-lock.txt
# make venv    .venv with everything installed and all kernels compiled (done by the others when needed)

PYTHON ?= python3
PROCESSES ?= 2
BIN := .venv/bin
STAMP := .venv/.installed
PEERS := .venv-peers
LOCK := requirements-lock.txt
INSTALL := $(BIN)/python -m pip install --quiet --disable-pip-version-check
SCENES := pipelines/scenes
# what is quick enough as plain Python, and what indexes most
NOJIT := tests/bem/algebra/test_interpolative_decomposition.py tests/bem/kernels/test_jit.py tests/mooring/lines/test_static.py
BOUNDS := tests/bem/green tests/bem/algebra tests/bem/kernels tests/bem/contour tests/bem/panels tests/mooring/lines
OLDEST := numba==0.63.* numpy==2.0.* scipy==1.13.*
NEWEST := numba<0.69 numpy scipy
ENDS := tests/bem/algebra tests/bem/kernels tests/bem/green tests/bem/depth_modes tests/mooring/lines/test_static.py
KERNELS = $(shell git diff --name-only --diff-filter=d main -- '*.py' | xargs -r grep -l '@kernel')
LIBRARIES := libglu1-mesa libgl1 libxcursor1 libxft2 libxinerama1 libxrender1

.PHONY: docs docs-serve lock demo test test-quick test-nojit test-bounds test-ends test-kernels bench lint types venv format clean
.DELETE_ON_ERROR:

venv: $(STAMP)

$(STAMP): pyproject.toml $(LOCK)
	@$(PYTHON) -c 'import sys; sys.exit(sys.version_info < (3, 11))' || \
	  { echo "make: $(PYTHON) is older than 3.11; give another with make PYTHON=…" >&2; exit 1; }
	@test -x $(BIN)/python || $(PYTHON) -m venv .venv || \
	  { rm -rf .venv; echo "make: no virtual environment could be made; on Debian: apt-get install python3-venv" >&2; exit 1; }
	$(INSTALL) -c $(LOCK) -e '.[test,page]' || \
	  { echo "make: the versions of $(LOCK) do not install here; the newest supported ones are taken" >&2; \
	    $(INSTALL) -e '.[test,page]'; }
	@$(BIN)/python -c 'import gmsh' || \
	  { echo "make: gmsh lacks shared libraries; on Debian: apt-get install $(LIBRARIES)" >&2; exit 1; }
	@$(BIN)/hakobune doctor --compile || echo 'make: not all kernels are compiled; commands compile what they lack' >&2
	@touch $@

demo: venv
	mkdir -p demo
	$(BIN)/hakobune solve $(SCENES)/series_box.toml --output demo/box_12m.h5
	$(BIN)/hakobune look demo/box_12m.h5 --plot demo/box_mesh.png
	$(BIN)/hakobune plot demo/box_12m.h5 --output demo/box_12m.png
	$(BIN)/hakobune solve $(SCENES)/series_box_20m.toml --output demo/box_20m.h5
	$(BIN)/hakobune plot demo/box_20m.h5 --output demo/box_20m.png
	$(BIN)/hakobune response $(SCENES)/response_box_20m.toml --database demo/box_20m.h5 \
	  --output demo/response.csv --plot demo/response.png
	$(BIN)/hakobune moor $(SCENES)/moor_chain_12.toml --database demo/box_20m.h5 --output demo/moor.h5

# HAKOBUNE_DOCS_EXECUTE=false leaves the notebooks without their results, half a minute less
docs: .venv/.docs
	@rm -f docs/notebooks/*.h5 # of a build that was ended
	NO_MKDOCS_2_WARNING=1 $(BIN)/mkdocs build --quiet
	@rm -f docs/notebooks/*.h5
	@echo "build/guide is written; open it with $(BIN)/python -m http.server -d build/guide, or make docs-serve"

docs-serve: .venv/.docs
	NO_MKDOCS_2_WARNING=1 HAKOBUNE_DOCS_EXECUTE=false $(BIN)/mkdocs serve

.venv/.docs: $(STAMP)
	$(INSTALL) -c $(LOCK) -e '.[docs]' || $(INSTALL) -e '.[docs]'
	@touch $@

lock: .venv/.docs
	{ grep '^#' $(LOCK); $(BIN)/python -m pip freeze --exclude-editable; } > $(LOCK).new
	mv $(LOCK).new $(LOCK)

bench: venv $(PEERS)/.installed
	$(BIN)/hakobune bench --peer $(PEERS)/bin/python --output bench $(if $(QUICK),--quick)

$(PEERS)/.installed:
	@test -x $(PEERS)/bin/python || $(PYTHON) -m venv $(PEERS)
	$(PEERS)/bin/python -m pip install --quiet --disable-pip-version-check capytaine==3.0.0
	@$(PEERS)/bin/python -m pip install --quiet --disable-pip-version-check --only-binary :all: pyhams==1.3.1 || \
	  echo "make: pyhams does not install here; the bench goes on without it" >&2
	@touch $@

lint: venv
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .
	$(BIN)/codespell

# where an environment forbids files of bytecode, each process of many would compile all sources again; and
# installed, since the packages lie beside hakobune in a checkout and below it in site-packages
types: venv
	rm -rf build/lib build/types
	$(BIN)/python -m pip install --quiet --disable-pip-version-check --no-deps --target build/types .
	@$(BIN)/python -m pip install --quiet --disable-pip-version-check 'pyright[nodejs]'
	$(BIN)/pyright --pythonpath $(BIN)/python

# each process has one BLAS thread: two wait for each other where the cores are taken (16 minutes of processor time, 10)
test: lint
	PYTHONDONTWRITEBYTECODE= OPENBLAS_NUM_THREADS=1 OMP_NUM_THREADS=1 $(BIN)/python -m pytest -n $(PROCESSES) --from-both-ends

test-quick: lint
	PYTHONDONTWRITEBYTECODE= OPENBLAS_NUM_THREADS=1 OMP_NUM_THREADS=1 $(BIN)/python tests/quick.py --processes $(PROCESSES)

# numpy warns where compiled code gives NaN or infinity in silence
test-nojit: venv
	NUMBA_DISABLE_JIT=1 $(BIN)/python -m pytest -W default::RuntimeWarning $(NOJIT) \
	  -k 'not (table_stays or impossible or inextensible)'

test-bounds: venv
	NUMBA_BOUNDSCHECK=1 HAKOBUNE_CACHE=$(CURDIR)/build/bounds $(BIN)/python -m pytest $(BOUNDS)

test-ends: .venv-oldest/.installed .venv-newest/.installed
	for end in oldest newest; do \
	  HAKOBUNE_CACHE=$(CURDIR)/build/$$end .venv-$$end/bin/python -m pytest $(ENDS) || exit 1; done

.venv-%/.installed: pyproject.toml
	$(PYTHON) -m venv .venv-$*
	.venv-$*/bin/python -m pip install --quiet --disable-pip-version-check --upgrade -e '.[test,page]' \
	  $(foreach one,$(if $(filter oldest,$*),$(OLDEST),$(NEWEST)),'$(one)')
	@touch $@

test-kernels:
	$(if $(KERNELS),$(MAKE) test-nojit test-bounds,@echo "this branch touches no kernel")

format: venv
	$(BIN)/ruff check --fix .
	$(BIN)/ruff format .

clean:
	rm -rf demo bench build .cache *.egg-info
