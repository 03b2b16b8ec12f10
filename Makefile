# make demo: everything from nothing to the drawn sheets; make test: the whole suite; make test-thorough: with all random
# mechanisms and many more examples; make lint: what CI demands; make bench: speed and errors measured anew (minutes, on a
# quiet machine).
PYTHON ?= python3
VENV := .venv
BIN := $(VENV)/bin
TASKS = problems/levers/task-% problems/linkages/2.%
LINKAGES = $(sort $(filter-out $(TASKS) problems/point/% problems/gears/% problems/meshing/%,$(wildcard problems/*/*.toml)))

# A file of tests is run by one worker, which solves and draws what they share once. Bytecode is kept, and out of the
# tree, also where the environment forbids it: to compile anew in every process is a tenth of the time.
TESTS := PYTHONDONTWRITEBYTECODE= PYTHONPYCACHEPREFIX=$(CURDIR)/$(VENV)/bytecode $(BIN)/python -m pytest -n 2 --dist loadfile

.PHONY: demo test test-every test-thorough test-lowest outputs lint size format regenerate tables schema examples messages tasks gallery docs group bench attack dist clean

# The compat mode is a plain path entry: the default finder costs every command a tenth of a second.
$(VENV)/.ready: pyproject.toml
	$(PYTHON) -m venv $(VENV)
	$(BIN)/python -m pip install --quiet --disable-pip-version-check --config-settings editable_mode=compat -e '.[dev]'
	touch $@

demo: $(VENV)/.ready
	$(BIN)/planmethod sheet --format svg,pdf -o out $(filter-out problems/machines/%,$(LINKAGES))
	$(BIN)/planmethod solve problems/gears/*.toml
	$(BIN)/planmethod sheet --format svg,pdf -o out problems/meshing/*.toml
	$(BIN)/planmethod check --key problems/linkages/ex3-variants.toml -o out
	$(BIN)/planmethod form problems/linkages/ex3-variants.toml --all-variants -o out
	$(BIN)/planmethod check problems/linkages/ex3-variants.toml problems/groups/ex3.csv -o out || test $$? -eq 1 # a cell cannot be read

test: $(VENV)/.ready
	$(TESTS)

test-every: $(VENV)/.ready
	$(TESTS) --every

test-thorough: $(VENV)/.ready
	$(TESTS) --thorough

# The suite with the lowest versions that pyproject.toml names; what they are deprecated for is theirs.
test-lowest: $(VENV)/.ready
	$(PYTHON) -m venv $(VENV)/lowest
	$(BIN)/python -m scripts.lowest > $(VENV)/lowest/requirements.txt
	$(VENV)/lowest/bin/python -m pip install --quiet --disable-pip-version-check -r $(VENV)/lowest/requirements.txt
	$(VENV)/lowest/bin/python -m pip install --quiet --disable-pip-version-check --no-deps -e .
	$(VENV)/lowest/bin/python -m pytest -n 2 --dist loadfile -W ignore::DeprecationWarning -W ignore::PendingDeprecationWarning

# What differs from the outputs that were taken; SHOW=pattern shows how, TAKE=1 takes it, sums and facts. Where many facts
# change it wants REASON="a sentence", which make hands on in the environment.
outputs: $(VENV)/.ready
	PYTHONPATH=$(CURDIR):$(CURDIR)/tests:$(CURDIR)/tests/outputs $(BIN)/python tests/outputs/look.py \
	  $(if $(SHOW),--show '$(SHOW)') $(if $(TAKE),--take)

lint: $(VENV)/.ready
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .
	$(BIN)/mypy
	$(BIN)/lint-imports

# Lines of code by room; warns above the budget of scripts/budget.toml.
size: $(VENV)/.ready
	$(BIN)/python scripts/size.py

format: $(VENV)/.ready
	$(BIN)/ruff check --fix .
	$(BIN)/ruff format .

# All generated files but pictures of the gallery and measurements; tests compare each of them.
regenerate: schema messages tables examples tasks

# Files in byte order, as the test of the document has them.
tables: $(VENV)/.ready
	$(BIN)/planmethod audit --lang en -o docs/published.md $(sort $(filter-out problems/cams/%,$(LINKAGES)) $(wildcard problems/gears/*.toml))

# What follows from the declared keys of flat tables: the schema, the references of keys in both languages.
schema: $(VENV)/.ready
	$(BIN)/python -m scripts.reference

# What commands print, in the pages of docs/ that show it.
examples: $(VENV)/.ready
	$(BIN)/python -m scripts.examples

# The sentences of click in the other languages, as gettext reads them.
messages: $(VENV)/.ready
	for text in planmethod/note/wording/*/LC_MESSAGES/click.po; do \
	  $(BIN)/python -c 'import polib, sys; polib.pofile(sys.argv[1]).save_as_mofile(sys.argv[2])' $$text $${text%.po}.mo; \
	done

# The index of the shipped problems, docs/tasks.md and its pictures.
tasks: $(VENV)/.ready
	$(BIN)/python -m benchmarks.tasks

# The pictures of the documentation; PICTURES='ex3 note' draws some.
gallery: $(VENV)/.ready
	$(BIN)/python -m scripts.gallery $(PICTURES)

# The book, into site/: the pages of docs/, the reference of docstrings. A link that leads nowhere fails it.
docs: $(VENV)/.ready
	$(BIN)/python -m pip install --quiet --disable-pip-version-check --config-settings editable_mode=compat -e '.[docs]'
	NO_MKDOCS_2_WARNING=1 $(BIN)/mkdocs build --quiet --site-dir site

# The works of thirty invented students: problems/groups/ex3.csv.
group: $(VENV)/.ready
	$(BIN)/python -m benchmarks.group

# Writes docs/speed-and-error.md and its figure; the peers come with the extra.
bench: $(VENV)/.ready
	$(BIN)/python -m pip install --quiet --disable-pip-version-check --config-settings editable_mode=compat -e '.[bench]'
	$(BIN)/python -m benchmarks $(LINKAGES)

# What strangers may send at every door: about an hour of two cores; ATTACK='--files 50' takes fewer.
attack: $(VENV)/.ready
	$(BIN)/python -m benchmarks.attack $(ATTACK)

# Source distribution and wheel in dist/, and the wheel tried in a clean environment.
dist: $(VENV)/.ready
	rm -rf dist build
	$(BIN)/python -m build --outdir dist
	$(BIN)/python scripts/wheel.py dist

clean:
	rm -rf $(VENV) build dist *.egg-info out/*.svg out/*.pdf out/*.png
